// The paper's Table 1 beside ours, and the question it ends on: what `--method paper` costs by
// brute-force rays, by Embree's rays, by the CPU's Z-buffer and by GL's, reduced there by the
// compute shader or read back as maps, and how that grows (its section 4.4).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "read_back.h"
#include "seconds_of.h"
#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/solid.h"
#include "zskel/skeleton/connect.h"
#include "zskel/visibility/surface_query.h"

namespace zskel::bench {
namespace {

struct PaperRow {
    const char* name;
    int faces;
    int vertices;
    int seconds;
    int nodes;
    int edges;
};
constexpr PaperRow kPaper[] = {
    {"mouse", 1890, 954, 125, 35, 34},      {"bull", 1978, 991, 137, 30, 29},
    {"octopus", 2000, 1002, 53, 68, 60},    {"cobra", 1715, 876, 49, 36, 35},
    {"frog", 1884, 945, 76, 29, 28},        {"horse", 1996, 1000, 170, 27, 26},
    {"horse_8k", 7984, 3994, 1028, 30, 29},
};
constexpr double kRanges[] = {0.03, 0.04, 0.05, 0.06, 0.08, 0.1};

std::unique_ptr<Backend> backend_of(BackendKind kind, int face_px) {
    BackendOptions options;
    options.kind = kind;
    options.face_px = face_px;
    return open_backend(options);
}

// The largest solid of a model with its seeds.
struct Subject {
    Solid solid;
    std::vector<Seed> seeds;
};

Subject load(const std::string& path) {
    const std::vector<Solid> solids = split_solids(prepare_surface(read_mesh(path)));
    const auto largest =
        std::max_element(solids.begin(), solids.end(), [](const Solid& l, const Solid& r) {
            return l.surface.triangles.size() < r.surface.triangles.size();
        });
    Subject subject{*largest, {}};
    subject.seeds = place_seeds(subject.solid.surface, SurfaceQuery(subject.solid.surface), {});
    return subject;
}

std::vector<Vec3> ends_of(const std::vector<SettledSeed>& settled) {
    std::vector<Vec3> ends;
    for (const SettledSeed& seed : settled) ends.push_back(seed.position);
    return ends;
}

std::size_t evaluations_of(const std::vector<SettledSeed>& settled) {
    std::size_t sum = 0;
    for (const SettledSeed& seed : settled) sum += seed.evaluations;
    return sum;
}

// A driver compiles its shaders at first use.
void look_once(VisibilitySource& source, std::span<const Seed> seeds) {
    EyeRecord record;
    source.look({&seeds.front().position, 1}, {&record, 1});
}

// Nodes, edges by formula 2, and edges without cycles, for every cluster range.
void print_model(const std::string& path, Backend& backend) {
    const Subject subject = load(path);
    const Surface& surface = subject.solid.surface;
    std::vector<SettledSeed> settled;
    look_once(*backend.prepare(surface), subject.seeds);
    const double seconds = seconds_of([&] {
        const auto source = backend.prepare(surface);
        settled = settle_seeds(*source, subject.seeds, PaperStepOptions{});
    });
    fmt::print("{:<28} {:>6} {:>6} {:>8.2f} {:>7} |",
               std::filesystem::path(path).filename().string(), surface.triangles.size(),
               surface.positions.size(), seconds, evaluations_of(settled));
    for (const double range : kRanges) {
        const Clusters clusters = cluster_minima(ends_of(settled), surface.edges, {range});
        const auto edges = connect_clusters(clusters.of_point, surface.edges);
        const auto forest = spanning_forest(clusters.centers, edges);
        fmt::print(" {:>4}/{:>3}/{:>3}", clusters.centers.size(), edges.size(), forest.size());
    }
    fmt::print("\n");
    std::fflush(stdout);
}

void print_table(const std::vector<std::string>& folders, Backend& backend) {
    fmt::print(
        "Table 1 of Wu et al. 2003 (P4, 1.5 GHz; 197 rays, step 0.0025) and ours by {} ({})\n",
        backend.info().name, backend.info().renderer);
    fmt::print(
        "Ours: nodes/edges by formula 2/edges when each cycle is opened at its longest, by cluster "
        "range\n\n");
    fmt::print("{:<28} {:>6} {:>6} {:>8} {:>7} |", "model", "faces", "verts", "seconds", "evals");
    for (const double range : kRanges) fmt::print(" {:>12}", range);
    fmt::print("\n");
    for (const PaperRow& row : kPaper) {
        fmt::print("{:<28} {:>6} {:>6} {:>8} {:>7} | {} nodes, {} edges after removal by hand\n",
                   fmt::format("paper: {}", row.name), row.faces, row.vertices, row.seconds, "",
                   row.nodes, row.edges);
        for (const std::string& folder : folders) {
            const std::string path = folder + "/" + row.name + ".obj";
            if (std::filesystem::exists(path)) print_model(path, backend);
        }
    }
}

struct Source {
    const char* name;
    BackendKind kind;
    bool reads_back;
};
constexpr Source kSources[] = {{"brute rays", BackendKind::Brute, false},
                               {"Embree", BackendKind::Ray, false},
                               {"CPU Z-buffer", BackendKind::Cpu, false},
                               {"GL, reduced", BackendKind::Gl, false},
                               {"GL, maps", BackendKind::Gl, true}};

// Seconds of settling some seeds with each source, for one change at a time.
void print_growth(const std::string& small, const std::string& large) {
    struct Case {
        const char* what;
        std::string model;
        std::size_t seeds;
        int face_px;
        double step;
    };
    const std::vector<Case> cases{
        {"base", small, 100, 6, 0.0025},         {"seeds x 2", small, 200, 6, 0.0025},
        {"samples x 4", small, 100, 12, 0.0025}, {"faces x 4", large, 100, 6, 0.0025},
        {"step x 2", small, 100, 6, 0.005},
    };
    fmt::print(
        "\nSeconds to settle seeds by the paper's steps, equal samples (section 4.4: seeds x "
        "samples x faces / step)\n\n");
    fmt::print("{:<14} {:>7} {:>8} {:>8} {:>7} {:>7}", "case", "faces", "seeds", "samples", "step",
               "evals");
    for (const Source& source : kSources) fmt::print(" {:>12} {:>7}", source.name, "ratio");
    fmt::print("\n");
    std::vector<double> base;
    for (const Case& c : cases) {
        Subject subject = load(c.model);
        std::vector<Seed> seeds;
        for (std::size_t i = 0; i < c.seeds; ++i)
            seeds.push_back(subject.seeds[i * subject.seeds.size() / c.seeds]);
        PaperStepOptions steps;
        steps.step_world = c.step;
        std::string line;
        std::size_t evaluations = 0;
        for (std::size_t s = 0; s < std::size(kSources); ++s) {
            const auto backend = backend_of(kSources[s].kind, c.face_px);
            const auto source = backend->prepare(subject.solid.surface);
            ReadBack read_back(*source);
            VisibilitySource& used = kSources[s].reads_back ? read_back : *source;
            look_once(used, seeds);
            const double seconds =
                seconds_of([&] { evaluations = evaluations_of(settle_seeds(used, seeds, steps)); });
            if (base.size() < std::size(kSources)) base.push_back(seconds);
            line += fmt::format(" {:>12.3f} {:>7.2f}", seconds, seconds / base[s]);
        }
        fmt::print("{:<14} {:>7} {:>8} {:>8} {:>7} {:>7}{}\n", c.what,
                   subject.solid.surface.triangles.size(), c.seeds, 6 * c.face_px * c.face_px,
                   c.step, evaluations, line);
        std::fflush(stdout);
    }
}

int run(int argc, char** argv) {
    CLI::App app("Prints the paper's Table 1 beside ours");
    std::vector<std::string> folders;
    std::string backend_name = "ray";
    bool with_growth = true;
    app.add_option("folders", folders, "Folders with mouse.obj, bull.obj, ...")->required();
    app.add_option("--backend", backend_name, "What settles the seeds of the table")
        ->capture_default_str();
    app.add_flag("!--no-growth", with_growth, "Leave the second table out");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto backend = backend_of(parse_backend(backend_name), 16);
        print_table(folders, *backend);
        if (with_growth)
            print_growth(folders.front() + "/horse.obj", folders.front() + "/horse_8k.obj");
        return 0;
    } catch (const Error& error) {
        log_line(LogLevel::Error, error.what());
        return static_cast<int>(error.code());
    }
}

}  // namespace
}  // namespace zskel::bench

int main(int argc, char** argv) {
    return zskel::bench::run(argc, argv);
}
