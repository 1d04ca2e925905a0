#include "zskel/rebuild/fidelity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "zskel/core/parallel.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

constexpr std::size_t kSamples = 50000;

// Places spread evenly by area: equal steps over the triangles' areas one after the other, and in
// each triangle the R2 sequence (Roberts 2018), which has no clusters.
std::vector<DVec3> places_on(const Mesh& mesh) {
    std::vector<double> until;
    double area = 0.0;
    for (const Triangle& t : mesh.triangles) {
        area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                             mesh.positions[t.z] - mesh.positions[t.x]));
        until.push_back(area);
    }
    std::vector<DVec3> places;
    places.reserve(kSamples);
    std::size_t at = 0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        const double wanted = area * (static_cast<double>(i) + 0.5) / kSamples;
        while (at + 1 < until.size() && until[at] < wanted) ++at;
        double u = std::fmod(static_cast<double>(i) * 0.7548776662466927, 1.0);
        double v = std::fmod(static_cast<double>(i) * 0.5698402909980532, 1.0);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const Triangle& t = mesh.triangles[at];
        places.push_back((1.0 - u - v) * mesh.positions[t.x] + u * mesh.positions[t.y] +
                         v * mesh.positions[t.z]);
    }
    return places;
}

}  // namespace

std::vector<double> distances_to(const Mesh& to, const std::vector<DVec3>& places) {
    const PreparedSurface prepared = prepare_surface(to);
    const Similarity& world = prepared.surface.world_from_model;
    const SurfaceQuery query(prepared.surface);
    std::vector<double> out(places.size());
    parallel_for(places.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            out[i] = world.length_to_model(query.nearest(world.to_world(places[i])).distance);
    });
    return out;
}

std::vector<char> are_seen(const std::vector<DVec3>& places, const VisibilityMaps& maps,
                           double within) {
    const Recall recall(maps);
    std::vector<char> is_seen(places.size(), 0);
    parallel_for(places.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            is_seen[i] =
                std::any_of(recall.maps().begin(), recall.maps().end(), [&](const RecallMap& map) {
                    return std::abs(map.look_at(places[i]).inside) <= within;
                });
        }
    });
    return is_seen;
}

double share_seen(const Mesh& mesh, const VisibilityMaps& maps, double within) {
    const std::vector<char> is_seen = are_seen(places_on(mesh), maps, within);
    return static_cast<double>(std::count(is_seen.begin(), is_seen.end(), 1)) /
           static_cast<double>(is_seen.size());
}

SurfaceDistances distances_between(const Mesh& a, const Mesh& b) {
    SurfaceDistances out;
    for (const std::vector<double>& d :
         {distances_to(b, places_on(a)), distances_to(a, places_on(b))}) {
        const double sum = std::accumulate(d.begin(), d.end(), 0.0);
        out.mean = std::max(out.mean, sum / static_cast<double>(d.size()));
        out.hausdorff = std::max(out.hausdorff, *std::max_element(d.begin(), d.end()));
    }
    return out;
}

}  // namespace zskel
