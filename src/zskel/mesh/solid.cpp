#include "zskel/mesh/solid.h"

#include <algorithm>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/edges.h"
#include "zskel/mesh/winding.h"

namespace zskel {
namespace {

struct Component {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> numbers;  // of its triangles in the whole surface
    Vec3 low{kInfinity};
    Vec3 high{-kInfinity};
    bool closed = false;
    std::vector<std::uint32_t> around;  // closed components that contain this one
};

std::vector<Component> collect(const PreparedSurface& prepared) {
    std::vector<Component> components(prepared.component_count);
    for (std::size_t t = 0; t < prepared.component.size(); ++t) {
        Component& part = components[prepared.component[t]];
        part.triangles.push_back(prepared.surface.triangles[t]);
        part.numbers.push_back(static_cast<std::uint32_t>(t));
        for (int k = 0; k < 3; ++k) {
            const Vec3& p = prepared.surface.positions[part.triangles.back()[k]];
            part.low = glm::min(part.low, p);
            part.high = glm::max(part.high, p);
        }
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
        components[i].closed = prepared.component_closed[i];
    }
    return components;
}

bool box_inside(const Component& inner, const Component& outer) {
    return glm::all(glm::greaterThanEqual(inner.low, outer.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
}

bool contains(const std::vector<Vec3>& positions, const Component& outer, const Component& inner) {
    constexpr std::size_t kSamples = 16;
    const std::size_t stride = std::max<std::size_t>(1, inner.triangles.size() / kSamples);
    for (std::size_t t = 0; t < inner.triangles.size(); t += stride) {
        const DVec3 sample(positions[inner.triangles[t].x]);
        if (winding_number(positions, outer.triangles, sample) < 0.5) return false;
    }
    return true;
}

// Gives every fan of triangles at a vertex a vertex of its own. Fans over an edge of more than two
// triangles count as one.
void part_fans(Solid& solid) {
    std::vector<Triangle>& triangles = solid.surface.triangles;
    struct Corner {
        glm::uvec2 edge;  // lower vertex first
        std::uint32_t low;
        std::uint32_t high;  // corners at its vertices: 3 x triangle + place in it
    };
    std::vector<Corner> corners;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3;
            glm::uvec2 edge(triangles[t][static_cast<int>(k)],
                            triangles[t][static_cast<int>(next)]);
            std::uint32_t low = 3 * t + k;
            std::uint32_t high = 3 * t + next;
            if (edge.x > edge.y) {
                std::swap(edge.x, edge.y);
                std::swap(low, high);
            }
            corners.push_back({edge, low, high});
        }
    }
    std::sort(corners.begin(), corners.end(),
              [](const Corner& l, const Corner& r) { return edge_before(l.edge, r.edge); });
    DisjointSets fans(triangles.size() * 3);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].edge != corners[i - 1].edge) continue;
        fans.unite(corners[i].low, corners[i - 1].low);
        fans.unite(corners[i].high, corners[i - 1].high);
    }
    std::vector<bool> is_taken(solid.vertex.size(), false);
    std::vector<std::uint32_t> of_fan(triangles.size() * 3, kNone);
    for (std::uint32_t corner = 0; corner < of_fan.size(); ++corner) {
        std::uint32_t& vertex = triangles[corner / 3][static_cast<int>(corner % 3)];
        std::uint32_t& own = of_fan[fans.find(corner)];
        if (own == kNone && is_taken[vertex]) {
            own = static_cast<std::uint32_t>(solid.vertex.size());
            solid.vertex.push_back(solid.vertex[vertex]);
        } else if (own == kNone) {
            own = vertex;
            is_taken[vertex] = true;
        }
        vertex = own;
    }
}

Solid make_solid(const PreparedSurface& prepared, const Component& shell,
                 const std::vector<const Component*>& cavities) {
    Solid solid;
    solid.is_closed = shell.closed;
    solid.cavity_count = static_cast<std::uint32_t>(cavities.size());
    Surface& surface = solid.surface;
    surface.world_from_model = prepared.surface.world_from_model;
    surface.triangles = shell.triangles;
    solid.triangle = shell.numbers;
    for (const Component* cavity : cavities) {
        for (const Triangle& t : cavity->triangles) surface.triangles.emplace_back(t.x, t.z, t.y);
        solid.triangle.insert(solid.triangle.end(), cavity->numbers.begin(), cavity->numbers.end());
    }
    for (const Triangle& t : surface.triangles) {
        solid.vertex.insert(solid.vertex.end(), {t.x, t.y, t.z});
    }
    std::sort(solid.vertex.begin(), solid.vertex.end());
    solid.vertex.erase(std::unique(solid.vertex.begin(), solid.vertex.end()), solid.vertex.end());
    for (Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            const auto at = std::lower_bound(solid.vertex.begin(), solid.vertex.end(), t[k]);
            t[k] = static_cast<std::uint32_t>(at - solid.vertex.begin());
        }
    }
    part_fans(solid);
    for (const std::uint32_t v : solid.vertex) {
        surface.positions.push_back(prepared.surface.positions[v]);
    }
    derive_normals_and_edges(surface);
    return solid;
}

}  // namespace

std::vector<Solid> split_solids(const PreparedSurface& prepared) {
    std::vector<Component> components = collect(prepared);
    for (Component& inner : components) {
        if (!inner.closed) continue;
        for (std::uint32_t o = 0; o < components.size(); ++o) {
            const Component& outer = components[o];
            if (&outer == &inner || !outer.closed || !box_inside(inner, outer)) continue;
            if (contains(prepared.surface.positions, outer, inner)) inner.around.push_back(o);
        }
    }
    std::vector<std::vector<const Component*>> cavities(components.size());
    for (const Component& part : components) {
        if (part.around.size() % 2 == 0) continue;
        // The nearest shell round a cavity is the one that lies inside all the others.
        const std::uint32_t shell = *std::max_element(
            part.around.begin(), part.around.end(), [&](std::uint32_t l, std::uint32_t r) {
                return components[l].around.size() < components[r].around.size();
            });
        cavities[shell].push_back(&part);
    }
    std::vector<Solid> solids;
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (components[i].around.size() % 2 != 0) continue;
        solids.push_back(make_solid(prepared, components[i], cavities[i]));
    }
    return solids;
}

}  // namespace zskel
