#include "zskel/skeleton/seeds.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr float kClearOfVertex =
    1e-5f;  // where the inward ray starts, past the vertex's own triangles

// Of more vertices than so many, one is as thick as its neighbour so near, in thicknesses, and
// turned alike (a cosine).
constexpr std::size_t kMostLookedFrom = 50'000;
constexpr float kAlikeWithin = 0.05f;
constexpr float kAlikeTurn = 0.99f;

constexpr int kMostHalvings = 8;
constexpr int kMostTurns = 200;
constexpr double kLeastInward = 0.05;  // cosine to a face's inside that will do

// The vertices at edges between whose points the way is not free, ascending.
std::vector<std::uint32_t> ends_of_unfree(std::span<const glm::uvec2> edges,
                                          std::span<const Vec3> points, const SurfaceQuery& query) {
    std::vector<std::uint8_t> is_free(edges.size());
    parallel_for(edges.size(), 64, [&](std::size_t begin, std::size_t end) {
        query.see(points, edges.subspan(begin, end - begin),
                  std::span(is_free).subspan(begin, end - begin));
    });
    std::vector<std::uint32_t> ends;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (is_free[e] == 0) ends.insert(ends.end(), {edges[e].x, edges[e].y});
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

// Of every vertex a neighbour to take after, or itself where no neighbour before it is its own
// model.
std::vector<std::uint32_t> model_neighbours(const Surface& surface) {
    std::vector<std::uint32_t> models(surface.positions.size());
    std::iota(models.begin(), models.end(), 0u);
    if (models.size() <= kMostLookedFrom) return models;
    // Sorted by their lower vertex: what that one is has been settled by then.
    for (const glm::uvec2& edge : surface.edges) {
        if (models[edge.x] == edge.x && models[edge.y] == edge.y) models[edge.y] = edge.x;
    }
    return models;
}

// For each vertex a direction to the inner side of all its faces, if there is any, by turning the
// reverse normal towards the inside of the face that it offends most (Rosenblatt's perceptron).
std::vector<Vec3> directions_into(const Surface& surface, std::span<const std::uint32_t> vertices) {
    std::vector<std::vector<DVec3>> inward(vertices.size());
    for (const glm::uvec3& t : surface.triangles) {
        const DVec3 a(surface.positions[t.x]);
        const DVec3 normal =
            glm::cross(DVec3(surface.positions[t.y]) - a, DVec3(surface.positions[t.z]) - a);
        if (!(glm::length(normal) > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const auto at = std::lower_bound(vertices.begin(), vertices.end(), t[k]);
            if (at != vertices.end() && *at == t[k])
                inward[static_cast<std::size_t>(at - vertices.begin())].push_back(
                    -glm::normalize(normal));
        }
    }
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        DVec3 direction(-surface.vertex_normals[vertices[i]]);
        const auto by_offence = [&](const DVec3& l, const DVec3& r) {
            return glm::dot(l, direction) < glm::dot(r, direction);
        };
        for (int turn = 0; turn < kMostTurns && !inward[i].empty(); ++turn) {
            const DVec3& worst = *std::min_element(inward[i].begin(), inward[i].end(), by_offence);
            if (glm::dot(worst, direction) > kLeastInward * glm::length(direction)) break;
            direction += worst;
        }
        const double length = glm::length(direction);
        directions.push_back(length > 0.0 ? Vec3(direction / length) : Vec3(0.0f));
    }
    return directions;
}

}  // namespace

std::vector<float> vertex_thickness(const Surface& surface, const SurfaceQuery& query) {
    const std::vector<std::uint32_t> models = model_neighbours(surface);
    std::vector<float> thickness(surface.positions.size());
    const auto look = [&](std::size_t v) {
        const Vec3 inward = -surface.vertex_normals[v];
        const Vec3 from = surface.positions[v] + inward * kClearOfVertex;
        thickness[v] = std::max(query.free_way(from, inward), kClearOfVertex);
    };
    const auto for_all = [&](const auto& work) {
        parallel_for(thickness.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) work(v);
        });
    };
    for_all([&](std::size_t v) {
        if (models[v] == v) look(v);
    });
    for_all([&](std::size_t v) {
        const std::uint32_t model = models[v];
        if (model == v) return;
        const float away = glm::distance(surface.positions[v], surface.positions[model]);
        const float turn = glm::dot(surface.vertex_normals[v], surface.vertex_normals[model]);
        if (away <= kAlikeWithin * thickness[model] && turn >= kAlikeTurn)
            thickness[v] = thickness[model];
        else
            look(v);
    });
    return thickness;
}

std::vector<Vec3> inner_points(const Surface& surface, std::span<const float> thickness,
                               const SeedOptions& options) {
    std::vector<Vec3> points;
    points.reserve(thickness.size());
    for (std::size_t v = 0; v < thickness.size(); ++v) {
        const double deepest = options.max_offset_thickness * static_cast<double>(thickness[v]);
        const auto offset = static_cast<float>(std::min(options.offset_world, deepest));
        points.push_back(surface.positions[v] - surface.vertex_normals[v] * offset);
    }
    return points;
}

std::vector<Vec3> walkable_points(const Surface& surface, const SurfaceQuery& query,
                                  std::vector<Vec3> inner) {
    const std::vector<std::uint32_t> stuck = ends_of_unfree(surface.edges, inner, query);
    if (stuck.empty()) return inner;
    const std::vector<Vec3> directions = directions_into(surface, stuck);
    const std::vector<Vec3> first = inner;
    std::vector<bool> has_moved(inner.size(), false);
    for (std::size_t i = 0; i < stuck.size(); ++i) {
        const Vec3& vertex = surface.positions[stuck[i]];
        inner[stuck[i]] = vertex + directions[i] * glm::distance(inner[stuck[i]], vertex);
        has_moved[stuck[i]] = true;
    }
    // The way along any other edge is as free as it was at first.
    const auto still_stuck = [&] {
        std::vector<glm::uvec2> edges;
        std::copy_if(
            surface.edges.begin(), surface.edges.end(), std::back_inserter(edges),
            [&](const glm::uvec2& edge) { return has_moved[edge.x] || has_moved[edge.y]; });
        return ends_of_unfree(edges, inner, query);
    };
    for (int halving = 0; halving < kMostHalvings; ++halving) {
        for (const std::uint32_t v : still_stuck()) {
            inner[v] = 0.5f * (inner[v] + surface.positions[v]);
            has_moved[v] = true;
        }
    }
    for (const std::uint32_t v : still_stuck()) inner[v] = first[v];
    return inner;
}

std::vector<Seed> place_seeds(const Surface& surface, const SurfaceQuery& query,
                              const SeedOptions& options) {
    std::vector<Seed> seeds;
    seeds.reserve(surface.positions.size());
    for (const Vec3& point : inner_points(surface, vertex_thickness(surface, query), options)) {
        seeds.push_back({point, static_cast<std::uint32_t>(seeds.size())});
    }
    return seeds;
}

}  // namespace zskel
