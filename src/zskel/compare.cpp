#include "zskel/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "zskel/mesh/bounds.h"
#include "zskel/mesh/solid.h"
#include "zskel/visibility/cpu_source.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

constexpr double kSubTexel = 1.0 / 256.0;  // GL_SUBPIXEL_BITS is 8 on what was tried

// Of records by coarser levels, and of skeletons that went by them, over the diagonal.
constexpr double kLevelForce = 5e-3;
constexpr double kLevelJacobian = 5e-2;
constexpr double kLevelDistance = 2e-3;

bool uses_levels(const BackendInfo& backend, std::size_t triangles) {
    return backend.has_levels && triangles >= kLevelsFrom;
}

constexpr double kForceMeansSomething = 0.05;  // of the mean of 1/r; below, its direction is noise

// The four neighbours of every texel, over the cube's edges too.
std::vector<std::array<std::uint32_t, 4>> texel_neighbours(int face_px) {
    const std::size_t count =
        6 * static_cast<std::size_t>(face_px) * static_cast<std::size_t>(face_px);
    std::vector<std::array<std::uint32_t, 4>> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Texel texel = texel_at(i, face_px);
        const CubeFace& face = cube_faces()[static_cast<std::size_t>(texel.face)];
        const DVec3 center = texel_direction(texel, face_px);
        const double pitch = 2.0 / face_px;
        const DVec3 right = DVec3(face.right) * pitch;
        const DVec3 up = DVec3(face.up) * pitch;
        const std::array<DVec3, 4> around{center + right, center - right, center + up, center - up};
        for (std::size_t k = 0; k < 4; ++k) {
            const Texel next = texel_of_direction(around[k], face_px);
            out[i][k] = static_cast<std::uint32_t>(texel_index(next, face_px));
        }
    }
    return out;
}

// What is no number is out of every bound.
double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    std::replace_if(
        values.begin(), values.end(), [](double v) { return std::isnan(v); },
        std::numeric_limits<double>::infinity());
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Difference difference_of(std::vector<double>& values) {
    return {quantile(values, 0.5), quantile(values, 0.999), quantile(values, 1.0), values.size()};
}

// |A - B| / |B| of two symmetric matrices, xx yy zz xy xz yz, by Frobenius' norm.
double jacobian_error(const std::array<float, 6>& a, const std::array<float, 6>& b) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        const double times = k < 3 ? 1.0 : 2.0;
        const auto reference = static_cast<double>(b[k]);
        difference += times * std::pow(static_cast<double>(a[k]) - reference, 2);
        size += times * reference * reference;
    }
    return size > 0.0 ? std::sqrt(difference / size) : 0.0;
}

// Gathers differences over any number of eyes and solids, then sums them up.
class Tally {
  public:
    void add(VisibilitySource& tested, VisibilitySource& reference, std::span<const Vec3> eyes) {
        const int face_px = reference.directions().face_px;
        if (face_px == 0 || tested.directions().face_px != face_px) {
            throw UsageError("only cube maps of one size can be compared texel by texel");
        }
        const auto neighbours = texel_neighbours(face_px);
        std::vector<EyeRecord> records(eyes.size());
        tested.look(eyes, records);
        MapBatch a;
        MapBatch b;
        for (std::size_t e = 0; e < eyes.size(); ++e) {
            tested.render(eyes.subspan(e, 1), a);
            reference.render(eyes.subspan(e, 1), b);
            add_texels(reference, eyes[e], a.view(0), b.view(0), neighbours);
            const bool same_ids = std::equal(a.id.begin(), a.id.end(), b.id.begin());
            add_record(reference, records[e], b.view(0), same_ids);
        }
        out_.eyes += eyes.size();
        out_.texels += eyes.size() * reference.directions().size();
    }

    SourceComparison finish() {
        std::vector<double> all = inner_;
        all.insert(all.end(), silhouette_.begin(), silhouette_.end());
        out_.inner = difference_of(inner_);
        out_.silhouette = difference_of(silhouette_);
        out_.all = difference_of(all);
        if (!inner_.empty()) {
            out_.id_agreement_inner =
                static_cast<double>(inner_same_) / static_cast<double>(inner_.size());
        }
        if (!all.empty())
            out_.id_agreement_all = static_cast<double>(same_) / static_cast<double>(all.size());
        out_.force_error_median = quantile(force_errors_, 0.5);
        out_.force_error_p95 = quantile(force_errors_, 0.95);
        out_.force_error_worst = quantile(force_errors_, 1.0);
        out_.jacobian_error_median = quantile(jacobian_errors_, 0.5);
        out_.jacobian_error_p95 = quantile(jacobian_errors_, 0.95);
        out_.jacobian_error_worst = quantile(jacobian_errors_, 1.0);
        out_.jacobians = jacobian_errors_.size();
        out_.angles = angles_.size();
        out_.angle_median_deg = quantile(angles_, 0.5);
        out_.angle_worst_deg = quantile(angles_, 1.0);
        return out_;
    }

  private:
    void add_texels(const VisibilitySource& reference, const Vec3& eye, const MapView& a,
                    const MapView& b, const std::vector<std::array<std::uint32_t, 4>>& neighbours) {
        for (std::size_t i = 0; i < b.distance.size(); ++i) {
            const bool hit_a = std::isfinite(a.distance[i]);
            const bool hit_b = std::isfinite(b.distance[i]);
            out_.one_sided += hit_a != hit_b ? 1 : 0;
            if (!hit_a || !hit_b) continue;
            const double difference =
                std::abs(static_cast<double>(a.distance[i]) - b.distance[i]) / b.distance[i];
            const bool same = a.id[i] == b.id[i];
            const bool inner = std::all_of(neighbours[i].begin(), neighbours[i].end(),
                                           [&](std::uint32_t n) { return b.id[n] == b.id[i]; });
            same_ += same ? 1 : 0;
            if (!inner) {
                silhouette_.push_back(difference);
                continue;
            }
            inner_same_ += same ? 1 : 0;
            if (inner_.empty() || difference > worst_) {
                worst_ = difference;
                out_.worst_inner = {reference.solid().world_from_model.to_model(eye),
                                    reference.directions().unit[i], a.distance[i], b.distance[i]};
            }
            inner_.push_back(difference);
        }
    }

    void add_record(const VisibilitySource& reference, const EyeRecord& a, const MapView& map,
                    bool same_ids) {
        const double mean = force_at(reference.directions(), map).mean_inverse_distance;
        if (!(mean > 0.0)) return;
        const EyeRecord b = summarize(reference.directions(), map, reference.solid());
        const DVec3 force_a(a.force);
        const DVec3 force_b(b.force);
        force_errors_.push_back(glm::distance(force_a, force_b) / mean);
        if (same_ids) jacobian_errors_.push_back(jacobian_error(a.jacobian, b.jacobian));
        const double floor = kForceMeansSomething * mean;
        if (glm::length(force_a) < floor || glm::length(force_b) < floor) return;
        const double angle =
            std::atan2(glm::length(glm::cross(force_a, force_b)), glm::dot(force_a, force_b));
        angles_.push_back(angle * 180.0 / std::numbers::pi);
    }

    SourceComparison out_;
    std::vector<double> inner_;
    std::vector<double> silhouette_;
    std::vector<double> force_errors_;
    std::vector<double> jacobian_errors_;
    std::vector<double> angles_;
    std::size_t same_ = 0;
    std::size_t inner_same_ = 0;
    double worst_ = 0.0;
};

}  // namespace

bool is_within(const SourceComparison& comparison, const ComparisonBounds& bounds) {
    return comparison.all.median <= bounds.texel_median &&
           comparison.inner.p999 <= bounds.inner_p999 &&
           comparison.force_error_p95 <= bounds.force_p95 &&
           comparison.jacobian_error_p95 <= bounds.jacobian_p95 &&
           comparison.angle_median_deg <= bounds.angle_median_deg;
}

ComparisonBounds bounds_of(const BackendInfo& backend, std::size_t triangles) {
    ComparisonBounds bounds;
    if (uses_levels(backend, triangles)) {
        bounds.force_p95 = kLevelForce;
        bounds.jacobian_p95 = kLevelJacobian;
    }
    if (backend.name == gl::name_of(gl::ContextKind::EglHardware)) bounds.inner_p999 = kSubTexel;
    return bounds;
}

std::vector<Vec3> comparison_eyes(const Surface& solid, VisibilitySource& source, int count,
                                  const ExtractOptions& options) {
    const std::size_t wanted = static_cast<std::size_t>(std::max(1, (count + 2) / 3));
    const SurfaceQuery query(solid);
    const std::vector<Seed> all = place_seeds(solid, query, options.paper.seeds);
    const std::size_t taken = std::min(wanted, all.size());
    std::vector<Seed> seeds;
    for (std::size_t i = 0; i < taken; ++i) seeds.push_back(all[i * all.size() / taken]);
    PaperStepOptions steps = options.paper.steps;
    steps.keep_paths = true;
    std::vector<Vec3> eyes;
    for (const SettledSeed& seed : settle_seeds(source, seeds, steps)) {
        if (seed.path.empty()) {
            eyes.push_back(seed.position);
        } else {
            eyes.insert(eyes.end(),
                        {seed.path.front(), seed.path[seed.path.size() / 2], seed.path.back()});
        }
    }
    return eyes;
}

SourceComparison compare_sources(VisibilitySource& tested, VisibilitySource& reference,
                                 std::span<const Vec3> eyes) {
    Tally tally;
    tally.add(tested, reference, eyes);
    return tally.finish();
}

SourceComparison compare_backends(const Mesh& mesh, Backend& tested, Backend& reference, int eyes,
                                  const ExtractOptions& options) {
    const PreparedSurface prepared = prepare_surface(mesh);
    Tally tally;
    for (const Solid& solid : split_solids(prepared)) {
        const double share = static_cast<double>(solid.surface.positions.size()) /
                             static_cast<double>(prepared.surface.positions.size());
        const auto a = tested.prepare(solid.surface);
        const auto b = reference.prepare(solid.surface);
        const int count = std::max(3, static_cast<int>(std::lround(eyes * share)));
        tally.add(*a, *b, comparison_eyes(solid.surface, *b, count, options));
    }
    return tally.finish();
}

namespace {

constexpr int kSamplesPerEdge = 16;

std::vector<DVec3> points_along(const SkeletonGraph& graph) {
    std::vector<DVec3> points;
    const auto degrees = node_degrees(graph);
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (degrees[n] == 0) points.push_back(graph.nodes[n].position);
    }
    double length = 0.0;
    for (const SkeletonGraph::Edge& e : graph.edges) {
        length += glm::distance(graph.nodes[e.source].position, graph.nodes[e.target].position);
    }
    // Even along the whole curve, about kSamplesPerEdge on an edge of mean length.
    const double spacing =
        length / (kSamplesPerEdge * std::max(1.0, static_cast<double>(graph.edges.size())));
    for (const SkeletonGraph::Edge& e : graph.edges) {
        const DVec3& a = graph.nodes[e.source].position;
        const DVec3& b = graph.nodes[e.target].position;
        const int pieces = std::max(
            1, static_cast<int>(std::ceil(glm::distance(a, b) / std::max(spacing, 1e-300))));
        for (int k = 0; k < pieces; ++k) points.push_back(glm::mix(a, b, (k + 0.5) / pieces));
    }
    return points;
}

double distance_to(const DVec3& p, const SkeletonGraph& graph) {
    double least = std::numeric_limits<double>::infinity();
    for (const SkeletonGraph::Node& node : graph.nodes)
        least = std::min(least, glm::distance(p, node.position));
    for (const SkeletonGraph::Edge& e : graph.edges) {
        const DVec3& a = graph.nodes[e.source].position;
        const DVec3 along = graph.nodes[e.target].position - a;
        const double length2 = glm::dot(along, along);
        const double t =
            length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(p, a + t * along));
    }
    return least;
}

double mean_one_way(const SkeletonGraph& from, const SkeletonGraph& to) {
    const std::vector<DVec3> points = points_along(from);
    if (points.empty()) return to.nodes.empty() ? 0.0 : std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const DVec3& p : points) sum += distance_to(p, to);
    return sum / static_cast<double>(points.size());
}

double diagonal_of(const Surface& surface) {
    return surface.world_from_model.length_to_model(box_of(surface.positions).diagonal());
}

}  // namespace

double mean_distance(const SkeletonGraph& a, const SkeletonGraph& b) {
    return 0.5 * (mean_one_way(a, b) + mean_one_way(b, a));
}

SkeletonComparison compare_skeletons(const ExtractResult& tested, const ExtractResult& reference,
                                     double tolerance) {
    SkeletonComparison out;
    out.seeds = std::min(tested.seeds.size(), reference.seeds.size());
    for (std::size_t s = 0; s < out.seeds; ++s) {
        if (!(glm::distance(tested.seeds[s].end, reference.seeds[s].end) <= tolerance)) {
            out.parted.push_back(reference.seeds[s].vertex);
        }
    }
    out.nodes_tested = tested.graph.nodes.size();
    out.nodes_reference = reference.graph.nodes.size();
    out.mean_distance_diagonals =
        mean_distance(tested.graph, reference.graph) / diagonal_of(reference.surface);
    return out;
}

bool is_within(const SkeletonComparison& comparison, const SkeletonBounds& bounds) {
    const auto reference = static_cast<double>(comparison.nodes_reference);
    const double apart = std::abs(static_cast<double>(comparison.nodes_tested) - reference);
    return static_cast<double>(comparison.parted.size()) <=
               bounds.parted_share * static_cast<double>(comparison.seeds) &&
           apart <= bounds.node_share * reference &&
           comparison.mean_distance_diagonals <= bounds.mean_distance_diagonals;
}

SkeletonBounds skeleton_bounds_of(const BackendInfo& backend, std::size_t triangles) {
    SkeletonBounds bounds;
    if (uses_levels(backend, triangles)) bounds.mean_distance_diagonals = kLevelDistance;
    return bounds;
}

}  // namespace zskel
