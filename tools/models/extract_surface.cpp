// Marching tetrahedra.
// An octree skips what lies further from the surface than its size, so only cells near it are
// sampled.
#include "extract_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "zskel/mesh/tetrahedra.h"

namespace zskel::models {
namespace {

constexpr double kHalfSide = 0.52;
/// The field may be somewhat steeper than 1 in fillets; what is further away than this is skipped.
constexpr double kSkipFactor = 1.5;

using Corner = glm::ivec3;

class Extraction {
  public:
    Extraction(const Field& field, int levels)
        : field_(field), side_(1 << levels), cell_(2.0 * kHalfSide / side_) {}

    Triangles run() {
        visit({0, 0, 0}, side_);
        return std::move(mesh_);
    }

  private:
    void visit(const Corner& low, int size) {
        const glm::dvec3 centre = position(glm::dvec3(low) + 0.5 * size);
        const double half_diagonal = 0.5 * size * cell_ * glm::length(glm::dvec3(1.0));
        if (std::abs(field_.distance(centre)) > kSkipFactor * half_diagonal) {
            return;
        }
        if (size == 1) {
            for (const auto& tetrahedron : kCellTetrahedra) {
                cut({low + tetrahedron[0], low + tetrahedron[1], low + tetrahedron[2],
                     low + tetrahedron[3]});
            }
            return;
        }
        for (int child = 0; child < 8; ++child) {
            const Corner step(child & 1, (child >> 1) & 1, child >> 2);
            visit(low + step * (size / 2), size / 2);
        }
    }

    void cut(const std::array<Corner, 4>& t) {
        int inside = 0;
        for (std::size_t i = 0; i < 4; ++i) inside |= (value(t[i]) < 0.0 ? 1 : 0) << i;
        cut_tetrahedron(inside, [&](std::span<const TetrahedronEdge> polygon) {
            const auto at = [&](std::size_t edge) {
                return crossing(t[static_cast<std::size_t>(polygon[edge].first)],
                                t[static_cast<std::size_t>(polygon[edge].second)]);
            };
            if (polygon.size() == 3) {
                emit(at(0), at(1), at(2));
                return;
            }
            const std::uint32_t a = at(0);
            const std::uint32_t b = at(1);
            const std::uint32_t c = at(2);
            const std::uint32_t d = at(3);
            emit(a, b, c);
            emit(a, c, d);
        });
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.faces.emplace_back(a, b, c);
    }

    glm::dvec3 position(const glm::dvec3& corner) const { return corner * cell_ - kHalfSide; }

    std::uint64_t index(const Corner& c) const {
        const auto n = static_cast<std::uint64_t>(side_) + 1;
        return (static_cast<std::uint64_t>(c.z) * n + static_cast<std::uint64_t>(c.y)) * n +
               static_cast<std::uint64_t>(c.x);
    }

    double value(const Corner& corner) {
        const auto [entry, is_new] = values_.try_emplace(index(corner), 0.0);
        if (is_new) {
            entry->second = field_.distance(position(glm::dvec3(corner)));
        }
        return entry->second;
    }

    std::uint32_t crossing(const Corner& a, const Corner& b) {
        const auto count = static_cast<std::uint32_t>(mesh_.vertices.size());
        const std::uint64_t ia = index(a), ib = index(b);
        const auto [entry, is_new] =
            crossings_[std::min(ia, ib)].try_emplace(std::max(ia, ib), count);
        if (is_new) {
            const double va = value(a), vb = value(b);
            mesh_.vertices.push_back(
                position(glm::mix(glm::dvec3(a), glm::dvec3(b), va / (va - vb))));
        }
        return entry->second;
    }

    const Field& field_;
    int side_;
    double cell_;
    Triangles mesh_;
    std::unordered_map<std::uint64_t, double> values_;
    std::unordered_map<std::uint64_t, std::unordered_map<std::uint64_t, std::uint32_t>> crossings_;
};

}  // namespace

Triangles extract_surface(const Field& field, int levels) {
    return Extraction(field, levels).run();
}

}  // namespace zskel::models
