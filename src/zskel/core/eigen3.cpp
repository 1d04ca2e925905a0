#include "zskel/core/eigen3.h"

#include <Eigen/Eigenvalues>

namespace zskel {

Eigen3 eigen_symmetric(const std::array<float, 6>& m) {
    Eigen::Matrix3d matrix;
    matrix << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    Eigen3 out;
    for (int k = 0; k < 3; ++k) {
        const auto column = solver.eigenvectors().col(2 - k);  // Eigen's come in rising order
        out.values[static_cast<std::size_t>(k)] = solver.eigenvalues()[2 - k];
        out.vectors[static_cast<std::size_t>(k)] = DVec3(column[0], column[1], column[2]);
    }
    return out;
}

}  // namespace zskel
