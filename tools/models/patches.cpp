#include "patches.h"

#include <map>
#include <tuple>
#include <utility>

namespace zskel::models {
namespace {

struct Before {
    template <typename V>
    bool operator()(const V& a, const V& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

/// Numbers points in the order in which they come first.
template <typename Point>
class Numbers {
  public:
    unsigned of(const Point& p) {
        return numbers_.try_emplace(p, static_cast<unsigned>(numbers_.size())).first->second;
    }
    std::size_t count() const { return numbers_.size(); }

  private:
    std::map<Point, unsigned, Before> numbers_;
};

glm::dvec4 bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

glm::dvec3 point_at(const BezierPatch& patch, double u, double v) {
    const glm::dvec4 along = bernstein(u);
    const glm::dvec4 across = bernstein(v);
    glm::dvec3 point(0.0);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            point += across[row] * along[column] *
                     patch[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        }
    }
    return point;
}

}  // namespace

Quads cube_boundary(const std::vector<glm::ivec3>& cubes) {
    std::map<glm::ivec3, bool, Before> is_full;
    for (const glm::ivec3& cube : cubes) {
        is_full[cube] = true;
    }
    Quads quads;
    Numbers<glm::ivec3> numbers;
    for (const glm::ivec3& cube : cubes) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                glm::ivec3 beside = cube;
                beside[axis] += side == 1 ? 1 : -1;
                if (is_full.contains(beside)) {
                    continue;
                }
                glm::uvec4 face;
                for (int k = 0; k < 4; ++k) {
                    // Around the side, counter-clockwise seen from outside.
                    const int turn = side == 1 ? k : 3 - k;
                    glm::ivec3 corner = cube;
                    corner[axis] += side;
                    corner[(axis + 1) % 3] += turn == 1 || turn == 2 ? 1 : 0;
                    corner[(axis + 2) % 3] += turn >= 2 ? 1 : 0;
                    face[k] = numbers.of(corner);
                    if (face[k] == quads.vertices.size()) {
                        quads.vertices.emplace_back(corner);
                    }
                }
                quads.faces.push_back(face);
            }
        }
    }
    return quads;
}

std::vector<BezierPatch> smooth_patches(const Quads& quads) {
    const std::size_t count = quads.faces.size();
    std::vector<unsigned> valence(quads.vertices.size(), 0);
    std::map<std::pair<unsigned, unsigned>, std::pair<std::size_t, int>> starts;  // of edges
    for (std::size_t f = 0; f < count; ++f) {
        for (int k = 0; k < 4; ++k) {
            ++valence[quads.faces[f][k]];
            starts[{quads.faces[f][k], quads.faces[f][(k + 1) % 4]}] = {f, k};
        }
    }
    // The inner control point next to each corner; the others are means of these.
    std::vector<std::array<glm::dvec3, 4>> inner(count);
    std::vector<glm::dvec3> corner(quads.vertices.size(), glm::dvec3(0.0));
    for (std::size_t f = 0; f < count; ++f) {
        for (int k = 0; k < 4; ++k) {
            const unsigned v = quads.faces[f][k];
            const double n = valence[v];
            const auto at = [&](int step) {
                return quads.vertices[quads.faces[f][(k + step) % 4]];
            };
            const glm::dvec3 point = (n * at(0) + 2.0 * at(1) + 2.0 * at(3) + at(2)) / (n + 5.0);
            inner[f][static_cast<std::size_t>(k)] = point;
            corner[v] += point / n;
        }
    }
    // Where control points stand in a patch: corners, those on the side that follows, and inside.
    constexpr std::array<std::array<std::size_t, 2>, 4> kCorner{{{0, 0}, {0, 3}, {3, 3}, {3, 0}}};
    constexpr std::array<std::array<std::size_t, 2>, 4> kNear{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
    constexpr std::array<std::array<std::size_t, 2>, 4> kFar{{{0, 2}, {2, 3}, {3, 1}, {1, 0}}};
    constexpr std::array<std::array<std::size_t, 2>, 4> kInner{{{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
    std::vector<BezierPatch> patches(count);
    for (std::size_t f = 0; f < count; ++f) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto place = [&](const std::array<std::size_t, 2>& at) -> glm::dvec3& {
                return patches[f][at[0]][at[1]];
            };
            const unsigned a = quads.faces[f][static_cast<int>(k)];
            const unsigned b = quads.faces[f][static_cast<int>((k + 1) % 4)];
            const auto& [other, there] = starts.at({b, a});
            const auto of_b = static_cast<std::size_t>(there);
            place(kCorner[k]) = corner[a];
            place(kInner[k]) = inner[f][k];
            place(kNear[k]) = 0.5 * (inner[f][k] + inner[other][(of_b + 1) % 4]);
            place(kFar[k]) = 0.5 * (inner[f][(k + 1) % 4] + inner[other][of_b]);
        }
    }
    return patches;
}

Triangles triangulate(const std::vector<BezierPatch>& patches, int steps) {
    constexpr double kSame = 1e9;  // points alike to so many parts are one
    Triangles mesh;
    Numbers<glm::dvec3> numbers;
    for (const BezierPatch& patch : patches) {
        const auto vertex = [&](int column, int row) {
            const glm::dvec3 point = point_at(patch, column / static_cast<double>(steps),
                                              row / static_cast<double>(steps));
            const unsigned number = numbers.of(glm::round(point * kSame));
            if (number == mesh.vertices.size()) {
                mesh.vertices.push_back(point);
            }
            return number;
        };
        for (int row = 0; row < steps; ++row) {
            for (int column = 0; column < steps; ++column) {
                const unsigned a = vertex(column, row);
                const unsigned c = vertex(column + 1, row + 1);
                mesh.faces.emplace_back(a, vertex(column + 1, row), c);
                mesh.faces.emplace_back(a, c, vertex(column, row + 1));
            }
        }
    }
    return mesh;
}

}  // namespace zskel::models
