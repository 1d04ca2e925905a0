#include "zskel/extract.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <numeric>
#include <utility>

#include "zskel/core/log.h"
#include "zskel/mesh/solid.h"
#include "zskel/skeleton/connect.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

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

// What a solid's stages leave, still in world space and with its own numbers.
struct SolidSkeleton {
    std::vector<Seed> seeds;
    std::vector<SettledSeed> settled;
    Clusters clusters;
    std::vector<glm::uvec2> edges;
    std::size_t forest_edges = 0;
    std::vector<double> radii;
};

SolidSkeleton extract_solid(const Solid& solid, const ExtractOptions& options, Backend& backend,
                            Stages& stages) {
    SolidSkeleton out;
    const Surface& surface = solid.surface;
    stages.begin("seeds");
    const SurfaceQuery query(surface);
    out.seeds = place_seeds(surface, query, options.seeds);
    stages.begin("settle");
    const auto source = backend.prepare(surface);
    out.settled = settle_seeds(*source, out.seeds, options.steps,
                               [&](double share) { stages.report(share); });
    stages.begin("cluster");
    std::vector<Vec3> ends;
    ends.reserve(out.settled.size());
    for (const SettledSeed& seed : out.settled) ends.push_back(seed.position);
    out.clusters = cluster_minima(ends, surface.edges, options.clusters);
    stages.begin("connect");
    out.edges = connect_clusters(out.clusters.of_point, surface.edges);
    out.forest_edges = spanning_forest(out.clusters.centers, out.edges).size();
    for (const Vec3& center : out.clusters.centers) {
        out.radii.push_back(static_cast<double>(query.nearest(center).distance));
    }
    return out;
}

class Assembler {
  public:
    Assembler(const Mesh& mesh, const PreparedSurface& prepared, ExtractResult& result)
        : result_(result),
          surface_node_(prepared.surface.positions.size(), kNone),
          input_vertex_(prepared.surface.positions.size(), kNone) {
        for (std::size_t v = mesh.positions.size(); v-- > 0;) {
            const std::uint32_t place = prepared.surface_vertex[v];
            if (place != kNone) input_vertex_[place] = static_cast<std::uint32_t>(v);
        }
    }

    void add(std::uint32_t number, const Solid& solid, SolidSkeleton& part) {
        const Similarity& to_world = solid.surface.world_from_model;
        const auto first = static_cast<std::uint32_t>(result_.graph.nodes.size());
        for (std::size_t n = 0; n < part.clusters.centers.size(); ++n) {
            result_.graph.nodes.push_back({to_world.to_model(part.clusters.centers[n]),
                                           to_world.length_to_model(part.radii[n]), number});
        }
        for (const glm::uvec2& edge : part.edges) {
            result_.graph.edges.push_back({edge.x + first, edge.y + first});
        }
        for (std::size_t s = 0; s < part.seeds.size(); ++s) {
            const std::uint32_t node = part.clusters.of_point[s] + first;
            const std::uint32_t place = solid.vertex[part.seeds[s].vertex];
            surface_node_[place] = node;
            add_seed(to_world, part.seeds[s], part.settled[s], node, input_vertex_[place]);
        }
        ExtractStatistics& sums = result_.statistics;
        sums.cavities += solid.cavity_count;
        sums.forest_edges += part.forest_edges;
        sums.seeds += part.seeds.size();
    }

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
    std::vector<std::uint32_t> surface_node_;
    std::vector<std::uint32_t> input_vertex_;  // the lowest at each place
};

// Says what a reader of the skeleton should not take on trust.
void add_warnings(const Mesh& mesh, const std::vector<Solid>& solids, ExtractResult& result) {
    result.warnings = mesh.warnings;
    for (const Repair& repair : result.repairs) {
        result.warnings.push_back(fmt::format("{}: {}", repair.what, repair.count));
    }
    std::size_t open = 0;
    for (const Solid& solid : solids) open += solid.is_closed ? 0 : 1;
    if (open > 0) {
        result.warnings.push_back(
            fmt::format("{} of {} parts are not closed: seeds may drift out through openings", open,
                        solids.size()));
    }
    std::array<std::size_t, 4> states{};
    for (const SeedReport& seed : result.seeds) ++states[static_cast<std::size_t>(seed.state)];
    for (const SeedState state : {SeedState::StepLimit, SeedState::LeftMesh, SeedState::NoHits}) {
        const std::size_t count = states[static_cast<std::size_t>(state)];
        if (count > 0) {
            result.warnings.push_back(fmt::format("{} of {} seeds ended as {}", count,
                                                  result.seeds.size(), name_of(state)));
        }
    }
    for (const std::string& warning : result.warnings) log_warning("{}: {}", mesh.name, warning);
}

}  // namespace

Method parse_method(std::string_view name) {
    if (name == "paper") return Method::Paper;
    throw UsageError(fmt::format("unknown method '{}': paper", name));
}

std::string_view name_of(Method) {
    return "paper";
}

double ExtractStatistics::seconds() const {
    return std::accumulate(stages.begin(), stages.end(), 0.0,
                           [](double sum, const StageTime& stage) { return sum + stage.seconds; });
}

ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options, Backend& backend) {
    ExtractResult result;
    Stages stages(result.statistics, options);
    stages.begin("prepare");
    PreparedSurface prepared = prepare_surface(mesh);
    const std::vector<Solid> solids = split_solids(prepared);
    result.repairs = prepared.repairs;
    result.statistics.faces = prepared.surface.triangles.size();
    result.statistics.vertices = prepared.surface.positions.size();
    result.statistics.solids = solids.size();
    Assembler assembler(mesh, prepared, result);
    for (std::uint32_t s = 0; s < solids.size(); ++s) {
        SolidSkeleton part = extract_solid(solids[s], options, backend, stages);
        assembler.add(s, solids[s], part);
    }
    assembler.map_vertices(prepared);
    stages.end();
    result.surface = std::move(prepared.surface);
    add_warnings(mesh, solids, result);
    return result;
}

}  // namespace zskel
