#include "zskel/extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <utility>

#include "zskel/core/log.h"
#include "zskel/mesh/self_intersections.h"
#include "zskel/mesh/solid.h"
#include "zskel/mesh/welded_mesh.h"
#include "zskel/skeleton/openings.h"
#include "zskel/skeleton/volumes.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

constexpr int kNewtonFacePx = 10;
// A seed, in the mean; for predictions only.
constexpr std::size_t kNewtonEvaluations = 5;
constexpr std::size_t kPaperEvaluations = 47;

// Adds up the seconds of each stage and passes progress on.
class Stages {
  public:
    Stages(ExtractStatistics& statistics, const ExtractOptions& options)
        : statistics_(statistics), options_(options) {}

    void begin(std::string_view stage) {
        const auto now = std::chrono::steady_clock::now();
        if (!stage_.empty()) {
            const std::chrono::duration<double> passed = now - start_;
            add(passed.count());
        }
        stage_ = stage;
        start_ = now;
        if (!stage.empty()) report(0.0);
    }
    void end() { begin(""); }

    void report(double share) const {
        if (options_.progress && !options_.progress(stage_, share)) throw Cancelled();
    }

  private:
    void add(double seconds) {
        for (StageTime& known : statistics_.stages) {
            if (known.stage == stage_) {
                known.seconds += seconds;
                return;
            }
        }
        statistics_.stages.push_back({stage_, seconds});
    }

    ExtractStatistics& statistics_;
    const ExtractOptions& options_;
    std::string stage_;
    std::chrono::steady_clock::time_point start_;
};

SolidSkeleton extract_solid(const Solid& solid, const SurfaceQuery& query,
                            const ExtractOptions& options, Backend& backend, Stages& stages) {
    const MethodProgress progress{[&](std::string_view stage) { stages.begin(stage); },
                                  [&](double share) { stages.report(share); }};
    SolidSkeleton skeleton;
    if (options.method == Method::Paper) {
        stages.begin("backend");
        const auto source = backend.prepare(solid.surface);
        skeleton = extract_by_paper(solid.surface, query, *source, options.paper, progress);
    } else {
        skeleton = extract_by_newton(
            solid.surface, query, solid.is_closed, [&] { return backend.prepare(solid.surface); },
            solid.is_sheet ? for_sheets(options.newton) : options.newton, progress);
        if (!solid.openings.empty()) run_to_openings(solid, query, skeleton);
    }
    stages.begin("check");
    if (solid.is_closed)
        skeleton.volumes = node_volumes(solid.surface, skeleton.vertex_node, skeleton.nodes);
    return skeleton;
}

class Assembler {
  public:
    Assembler(const PreparedSurface& prepared, ExtractResult& result)
        : result_(result),
          surface_node_(prepared.surface.positions.size(), kNone),
          input_vertex_(prepared.input_vertex) {}

    void add(std::uint32_t number, const Solid& solid, const SurfaceQuery& query,
             SolidSkeleton& part) {
        const Similarity& to_world = solid.surface.world_from_model;
        const auto first = static_cast<std::uint32_t>(result_.graph.nodes.size());
        for (std::size_t n = 0; n < part.nodes.size(); ++n) {
            const auto radius = static_cast<double>(part.radii[n]);
            const double volume = part.volumes.empty() ? 0.0 : part.volumes[n];
            const double unit = to_world.length_to_model(1.0);
            result_.graph.nodes.push_back({to_world.to_model(part.nodes[n]),
                                           to_world.length_to_model(radius), number,
                                           volume * unit * unit * unit});
        }
        for (const std::uint32_t n : part.open_ends)
            result_.graph.nodes[first + n].is_open_end = true;
        for (const glm::uvec2& edge : part.edges) {
            result_.graph.edges.push_back({edge.x + first, edge.y + first});
        }
        for (std::size_t v = 0; v < part.vertex_node.size(); ++v) {
            surface_node_[solid.vertex[v]] = part.vertex_node[v] + first;
        }
        for (std::size_t s = 0; s < part.seeds.size(); ++s) {
            const std::uint32_t place = solid.vertex[part.seeds[s].vertex];
            add_seed(to_world, part.seeds[s], part.settled[s], surface_node_[place],
                     input_vertex_[place]);
        }
        for (const SmallHandle& handle : part.ignored_handles) {
            result_.ignored_handles.push_back({to_world.length_to_model(handle.radius),
                                               to_world.to_model(handle.position), handle.is_cut,
                                               number});
        }
        checker_.add(solid, query, part);
        ExtractStatistics& sums = result_.statistics;
        if (part.seed_spacing_thickness >= sums.seed_spacing_thickness) {
            sums.seed_spacing_thickness = part.seed_spacing_thickness;
            sums.seed_end = part.seed_end;
        }
        sums.cavities += solid.cavity_count;
        sums.openings += solid.openings.size();
        sums.open_ends += part.open_ends.size();
        sums.forest_edges += part.forest_edges;
        sums.seeds += part.seeds.size();
        sums.expected_cycles += part.expected_cycles;
        sums.limbs += part.limbs;
        sums.rejected_limbs += part.rejected_limbs;
        sums.refine.merged_junctions += part.refine.merged_junctions;
        sums.refine.extended_ends += part.refine.extended_ends;
        sums.refine.unfolded_branches += part.refine.unfolded_branches;
        sums.refine.zipped_branches += part.refine.zipped_branches;
        result_.warnings.insert(result_.warnings.end(), part.warnings.begin(), part.warnings.end());
    }

    // What was found, beside what should have been.
    void finish_check() { result_.check = checker_.finish(result_.graph); }

    void map_vertices(const PreparedSurface& prepared) {
        result_.graph.vertex_node.reserve(prepared.surface_vertex.size());
        for (const std::uint32_t place : prepared.surface_vertex) {
            result_.graph.vertex_node.push_back(place == kNone ? kNone : surface_node_[place]);
        }
    }

  private:
    void add_seed(const Similarity& to_world, const Seed& seed, SettledSeed& settled,
                  std::uint32_t node, std::uint32_t vertex) {
        SeedReport report;
        report.vertex = vertex;
        report.node = node;
        report.start = to_world.to_model(seed.position);
        report.end = to_world.to_model(settled.position);
        report.state = settled.state;
        report.steps = settled.steps;
        report.evaluations = settled.evaluations;
        for (const Vec3& p : settled.path) report.path.push_back(to_world.to_model(p));
        result_.statistics.evaluations += settled.evaluations;
        result_.seeds.push_back(std::move(report));
    }

    ExtractResult& result_;
    SkeletonChecker checker_;
    std::vector<std::uint32_t> surface_node_;
    const std::vector<std::uint32_t>& input_vertex_;  // at each place
};

// Caps come last.
Surface without_caps(Surface surface, std::size_t faces) {
    if (surface.triangles.size() == faces) return surface;
    surface.triangles.resize(faces);
    derive_normals(surface);
    derive_edges(surface);
    return surface;
}

// What is known of the parts that are no solids, by method newton, and of what lies in solids.
void add_part_warnings(const std::vector<Solid>& solids, const ExtractOptions& options,
                       ExtractResult& result) {
    const auto open = std::count_if(solids.begin(), solids.end(),
                                    [](const Solid& solid) { return !solid.is_closed; });
    if (open > 0) {
        result.warnings.push_back(fmt::format(
            "{} of {} parts are not closed: {}", open, solids.size(),
            options.method == Method::Paper
                ? "seeds may drift out through openings"
                : "the skeleton of each is in one piece and without cycles, whatever the part's "
                  "handles; it may leave through openings"));
    }
    const std::size_t cavities = result.statistics.cavities;
    if (cavities > 0) {
        result.warnings.push_back(
            fmt::format("{}: the skeleton lies between the shells",
                        cavities == 1 ? "1 cavity" : fmt::format("{} cavities", cavities)));
    }
    if (!result.ignored_handles.empty()) {
        result.warnings.push_back(
            fmt::format("handles of a radius below {} left without a cycle: {}",
                        options.newton.min_handle_model, result.ignored_handles.size()));
    }
}

// In larger models a surface that passes through itself is looked for only where something is
// amiss: the search takes a tenth as long as all the rest.
constexpr std::size_t kFacesAlwaysLooked = 100000;

void add_crossing_warning(const Mesh& mesh, ExtractResult& result) {
    std::vector<Repair> repairs;
    const WeldedMesh welded = weld_equal(mesh, repairs);
    const auto found = crossing_triangles(welded.positions, welded.triangles,
                                          bearable_pairs(welded.triangles.size()));
    if (!found || found->empty()) return;
    result.warnings.push_back(
        fmt::format("{} triangles pass through others: what is inside, and round what, is not sure "
                    "there; --join makes one surface of what overlaps",
                    found->size()));
}

// Says what a reader of the skeleton should not take on trust.
void add_warnings(const Mesh& mesh, const std::vector<Solid>& solids, const ExtractOptions& options,
                  ExtractResult& result) {
    const bool is_amiss = !result.warnings.empty() || !result.check.failures.empty();
    result.warnings.insert(result.warnings.begin(), mesh.warnings.begin(), mesh.warnings.end());
    for (const Repair& repair : result.repairs) {
        result.warnings.push_back(fmt::format("{}: {}", repair.what, repair.count));
    }
    add_part_warnings(solids, options, result);
    std::array<std::size_t, 4> states{};
    for (const SeedReport& seed : result.seeds) ++states[static_cast<std::size_t>(seed.state)];
    for (const SeedState state : {SeedState::StepLimit, SeedState::LeftMesh, SeedState::NoHits}) {
        const std::size_t count = states[static_cast<std::size_t>(state)];
        // Single seeds that are still on their way do no harm; all are counted in the output.
        const std::size_t bearable = state == SeedState::StepLimit ? result.seeds.size() / 100 : 0;
        if (count > bearable) {
            result.warnings.push_back(fmt::format("{} of {} seeds ended as {}", count,
                                                  result.seeds.size(), name_of(state)));
        }
    }
    const std::size_t most = SpreadOptions{}.max_seeds;
    if (result.statistics.seed_end == SpreadEnd::Limit && options.newton.spread.max_seeds == most) {
        result.warnings.push_back(fmt::format(
            "more than {} seeds would be needed: some limbs are {:.2g} of their thickness from the "
            "next; --seeds allows more",
            most, result.statistics.seed_spacing_thickness));
    }
    for (const std::string& failure : result.check.failures)
        result.warnings.push_back("self-check: " + failure);
    if (is_amiss || mesh.triangles.size() <= kFacesAlwaysLooked) add_crossing_warning(mesh, result);
    for (const std::string& warning : result.warnings) log_warning("{}: {}", mesh.name, warning);
}

}  // namespace

Method parse_method(std::string_view name) {
    if (name == "newton") return Method::Newton;
    if (name == "paper") return Method::Paper;
    throw UsageError(fmt::format("unknown method '{}': newton or paper", name));
}

std::string_view name_of(Method method) {
    return method == Method::Newton ? "newton" : "paper";
}

double ExtractStatistics::seconds() const {
    return std::accumulate(stages.begin(), stages.end(), 0.0,
                           [](double sum, const StageTime& stage) { return sum + stage.seconds; });
}

BackendOptions backend_options_for(const Mesh& mesh, const ExtractOptions& options,
                                   BackendOptions backend) {
    const bool is_paper = options.method == Method::Paper;
    const std::size_t vertices = mesh.positions.size();
    const SpreadOptions& spread = options.newton.spread;
    const std::size_t usual = std::min(
        spread.max_seeds, std::max(spread.min_seeds, spread.min_seeds / 2 + spread.many_seeds / 2));
    const std::size_t seeds = is_paper ? vertices : std::min(vertices, usual);
    if (backend.face_px == 0) backend.face_px = is_paper ? kDefaultFacePx : kNewtonFacePx;
    backend.work.faces = mesh.triangles.size();
    backend.work.evaluations = seeds * (is_paper ? kPaperEvaluations : kNewtonEvaluations);
    return backend;
}

namespace {

constexpr double kLeastHandleVoxels = 2.0;

// Of the parts' union; vertices go by the nearest of its surface.
ExtractResult extract_joined(const Mesh& mesh, ExtractOptions options, Backend& backend) {
    const JoinedMesh joined = join_parts(mesh, options.repair, *std::exchange(options.join, {}));
    // Where parts touch, sampling makes holes of about a voxel.
    options.newton.min_handle_model =
        std::max(options.newton.min_handle_model, kLeastHandleVoxels * joined.voxel_model);
    ExtractResult result = extract_skeleton(joined.mesh, options, backend);
    std::vector<std::uint32_t> vertex_node;
    vertex_node.reserve(joined.nearest.size());
    for (const std::uint32_t v : joined.nearest)
        vertex_node.push_back(v == kNone ? kNone : result.graph.vertex_node[v]);
    result.graph.vertex_node = std::move(vertex_node);
    std::vector<std::uint32_t> input_vertex(joined.mesh.positions.size(), kNone);
    for (std::uint32_t v = 0; v < joined.nearest.size(); ++v) {
        if (joined.nearest[v] != kNone) input_vertex[joined.nearest[v]] = v;
    }
    for (SeedReport& seed : result.seeds) seed.vertex = input_vertex[seed.vertex];
    for (const Repair& repair : joined.repairs) {
        result.repairs.push_back(repair);
        result.warnings.push_back(fmt::format("{}: {}", repair.what, repair.count));
        log_warning("{}: {}", mesh.name, result.warnings.back());
    }
    return result;
}

}  // namespace

ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options, Backend& backend) {
    if (options.join) return extract_joined(mesh, options, backend);
    ExtractResult result;
    Stages stages(result.statistics, options);
    stages.begin("prepare");
    PreparedSurface prepared = prepare_surface(
        mesh, options.method == Method::Paper ? WorldSize::UnitCube : WorldSize::Spread,
        options.repair);
    const std::vector<Solid> solids = split_solids(prepared);
    result.repairs = prepared.repairs;
    const auto caps =
        std::count(prepared.input_triangle.begin(), prepared.input_triangle.end(), kNone);
    result.statistics.faces = prepared.surface.triangles.size() - static_cast<std::size_t>(caps);
    result.statistics.vertices = prepared.surface.positions.size();
    result.statistics.solids = solids.size();
    Assembler assembler(prepared, result);
    for (std::uint32_t s = 0; s < solids.size(); ++s) {
        stages.begin("hierarchy");
        const SurfaceQuery query(solids[s].surface);
        SolidSkeleton part = extract_solid(solids[s], query, options, backend, stages);
        assembler.add(s, solids[s], query, part);
    }
    assembler.map_vertices(prepared);
    result.surface = without_caps(std::move(prepared.surface), result.statistics.faces);
    assembler.finish_check();
    stages.end();
    add_warnings(mesh, solids, options, result);
    return result;
}

}  // namespace zskel
