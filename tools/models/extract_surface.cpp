// Marching tetrahedra (Doi and Koide 1991) on cells cut in six around their diagonal (Kuhn 1960).
// An octree skips what lies further from the surface than its size, so only cells near it are
// sampled.
#include "extract_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace zskel::models {
namespace {

constexpr double kHalfSide = 0.52;
/// The field may be somewhat steeper than 1 in fillets; what is further away than this is skipped.
constexpr double kSkipFactor = 1.5;

using Corner = glm::ivec3;

/// The six tetrahedra of a unit cell, all turning the same way.
constexpr std::array<std::array<glm::ivec3, 4>, 6> kTetrahedra = {{
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}}},
    {{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}}},
    {{{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}},
}};

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
            for (const auto& tetrahedron : kTetrahedra) {
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

    /// Every choice below is an even permutation, so the triangles keep the tetrahedron's turn.
    void cut(const std::array<Corner, 4>& t) {
        static constexpr int kEven[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
        static constexpr int kPairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                             {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
        int inside = 0;
        for (int i = 0; i < 4; ++i) {
            inside |= (value(t[static_cast<std::size_t>(i)]) < 0.0 ? 1 : 0) << i;
        }
        const auto at = [&](int i) { return t[static_cast<std::size_t>(i)]; };
        for (const auto& e : kEven) {
            const std::array<Corner, 4> v = {at(e[0]), at(e[1]), at(e[2]), at(e[3])};
            if (inside == 1 << e[0]) {
                emit(crossing(v[0], v[1]), crossing(v[0], v[2]), crossing(v[0], v[3]));
            } else if (inside == (15 ^ (1 << e[0]))) {
                emit(crossing(v[0], v[1]), crossing(v[0], v[3]), crossing(v[0], v[2]));
            }
        }
        for (const auto& p : kPairs) {
            if (inside == (1 << p[0] | 1 << p[1])) {
                const std::uint32_t a = crossing(at(p[0]), at(p[2]));
                const std::uint32_t b = crossing(at(p[0]), at(p[3]));
                const std::uint32_t c = crossing(at(p[1]), at(p[3]));
                const std::uint32_t d = crossing(at(p[1]), at(p[2]));
                emit(a, b, c);
                emit(a, c, d);
            }
        }
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
