#include "zskel/mesh/solid.h"

#include <algorithm>
#include <numeric>

#include "zskel/core/disjoint_sets.h"
#include "zskel/core/parallel.h"
#include "zskel/mesh/sides.h"
#include "zskel/mesh/winding_tree.h"

namespace zskel {
namespace {

struct Component {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> numbers;  // of its triangles in the whole surface
    Vec3 low{kInfinity};
    Vec3 high{-kInfinity};
    bool closed = false;
    bool sheet = false;
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
        components[i].sheet = prepared.component_sheet[i];
    }
    return components;
}

bool box_inside(const Component& inner, const Component& outer) {
    return glm::all(glm::greaterThanEqual(inner.low, outer.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
}

bool contains(const WindingTree& outer, const std::vector<Vec3>& positions,
              const Component& inner) {
    constexpr std::size_t kSamples = 16;
    const std::size_t stride = std::max<std::size_t>(1, inner.triangles.size() / kSamples);
    for (std::size_t t = 0; t < inner.triangles.size(); t += stride) {
        if (outer.at(DVec3(positions[inner.triangles[t].x])) < 0.5) return false;
    }
    return true;
}

// Finds what lies in what: closed components whose box lies in another's are looked at.
void nest(std::vector<Component>& components, const std::vector<Vec3>& positions) {
    std::vector<std::uint32_t> closed;
    for (std::uint32_t c = 0; c < components.size(); ++c) {
        if (components[c].closed) closed.push_back(c);
    }
    std::sort(closed.begin(), closed.end(), [&](std::uint32_t l, std::uint32_t r) {
        return components[l].low.x < components[r].low.x;
    });
    std::vector<std::vector<std::uint32_t>> inside(components.size());
    parallel_for(closed.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Component& outer = components[closed[i]];
            std::vector<std::uint32_t>& found = inside[closed[i]];
            auto first =
                std::lower_bound(closed.begin(), closed.end(), outer.low.x,
                                 [&](std::uint32_t c, float x) { return components[c].low.x < x; });
            for (; first != closed.end() && components[*first].low.x <= outer.high.x; ++first) {
                if (*first != closed[i] && box_inside(components[*first], outer))
                    found.push_back(*first);
            }
            if (found.empty()) continue;
            const WindingTree tree(positions, outer.triangles);
            std::erase_if(found, [&](std::uint32_t inner) {
                return !contains(tree, positions, components[inner]);
            });
        }
    });
    for (std::uint32_t outer = 0; outer < inside.size(); ++outer) {
        for (const std::uint32_t inner : inside[outer]) components[inner].around.push_back(outer);
    }
}

// The shell that a cavity is in: of the shells round it the one that lies inside the most; kNone
// where there is none, since shells that cut each other may each lie round the other.
std::uint32_t shell_round(const Component& part, const std::vector<Component>& components) {
    std::uint32_t best = kNone;
    if (part.around.size() % 2 == 0) return best;
    for (const std::uint32_t c : part.around) {
        const std::size_t depth = components[c].around.size();
        if (depth % 2 == 0 && (best == kNone || depth > components[best].around.size())) best = c;
    }
    return best;
}

// Gives every fan of triangles at a vertex a vertex of its own. Fans over an edge of more than two
// triangles count as one.
void part_fans(Solid& solid) {
    std::vector<Triangle>& triangles = solid.surface.triangles;
    const std::vector<Side> sides = sorted_sides(triangles, solid.vertex.size());
    DisjointSets fans(triangles.size() * 3);
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].edge != sides[i - 1].edge) continue;
        fans.unite(sides[i].low_corner(), sides[i - 1].low_corner());
        fans.unite(sides[i].high_corner(), sides[i - 1].high_corner());
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

// So that its skeleton is the same whatever else the model holds.
void place_in_own_world(Solid& solid, const PreparedSurface& prepared) {
    std::vector<DVec3> places;
    for (const std::uint32_t v : solid.vertex) places.push_back(prepared.places[v]);
    Surface& surface = solid.surface;
    surface.world_from_model =
        scale_by_spread(places, surface.triangles, prepared.surface.world_from_model);
    for (const DVec3& place : places)
        surface.positions.push_back(surface.world_from_model.to_world(place));
}

// Parts the fans, and derives what follows from the vertices when that is not known yet.
void finish(Solid& solid, const PreparedSurface& prepared) {
    if (!prepared.fans_are_whole) part_fans(solid);
    Surface& surface = solid.surface;
    if (surface.positions.size() == solid.vertex.size()) return;
    surface.positions.clear();
    if (prepared.places.empty()) {
        for (const std::uint32_t v : solid.vertex)
            surface.positions.push_back(prepared.surface.positions[v]);
    } else {
        place_in_own_world(solid, prepared);
    }
    derive_normals(surface);
    derive_edges(surface);
}

// The only part of a surface: all of it.
Solid whole_surface(const PreparedSurface& prepared) {
    Solid solid;
    solid.is_closed = prepared.component_closed.front();
    solid.is_sheet = prepared.component_sheet.front();
    solid.surface = prepared.surface;
    solid.vertex.resize(solid.surface.positions.size());
    std::iota(solid.vertex.begin(), solid.vertex.end(), 0u);
    solid.triangle.resize(solid.surface.triangles.size());
    std::iota(solid.triangle.begin(), solid.triangle.end(), 0u);
    return solid;
}

// `number` maps vertices of the whole to those of the solid; kNone on entry, and again on return.
Solid one_of_many(const PreparedSurface& prepared, const Component& shell,
                  const std::vector<const Component*>& cavities,
                  std::vector<std::uint32_t>& number) {
    Solid solid;
    solid.is_closed = shell.closed;
    solid.is_sheet = shell.sheet;
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
        for (int k = 0; k < 3; ++k) {
            if (number[t[k]] == kNone) solid.vertex.push_back(t[k]);
            number[t[k]] = 0;
        }
    }
    std::sort(solid.vertex.begin(), solid.vertex.end());
    for (std::uint32_t v = 0; v < solid.vertex.size(); ++v) number[solid.vertex[v]] = v;
    for (Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) t[k] = number[t[k]];
    }
    for (const std::uint32_t v : solid.vertex) number[v] = kNone;
    return solid;
}

std::vector<Solid> group_components(const PreparedSurface& prepared) {
    if (prepared.component_count == 1) {
        std::vector<Solid> solids;
        solids.push_back(whole_surface(prepared));
        finish(solids.front(), prepared);
        return solids;
    }
    std::vector<Component> components = collect(prepared);
    nest(components, prepared.surface.positions);
    std::vector<std::vector<const Component*>> cavities(components.size());
    std::vector<bool> is_shell(components.size(), true);
    for (std::size_t i = 0; i < components.size(); ++i) {
        const std::uint32_t shell = shell_round(components[i], components);
        is_shell[i] = shell == kNone;
        if (!is_shell[i]) cavities[shell].push_back(&components[i]);
    }
    std::vector<Solid> solids;
    std::vector<std::uint32_t> number(prepared.surface.positions.size(), kNone);
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (!is_shell[i]) continue;
        solids.push_back(one_of_many(prepared, components[i], cavities[i], number));
        finish(solids.back(), prepared);
    }
    return solids;
}

}  // namespace

std::vector<Solid> split_solids(const PreparedSurface& prepared) {
    std::vector<Solid> solids = group_components(prepared);
    if (prepared.openings.empty()) return solids;
    std::vector<std::uint32_t> solid_of(prepared.component_count, kNone);
    for (std::uint32_t s = 0; s < solids.size(); ++s) {
        for (std::uint32_t t = 0; t < solids[s].triangle.size(); ++t) {
            const std::uint32_t whole = solids[s].triangle[t];
            solid_of[prepared.component[whole]] = s;
            if (prepared.input_triangle[whole] == kNone) solids[s].caps.push_back(t);
        }
    }
    for (const Opening& opening : prepared.openings)
        solids[solid_of[opening.component]].openings.push_back(opening);
    return solids;
}

}  // namespace zskel
