// zskel extract: a mesh in, a skeleton out, with pictures and dumps on request.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "command.h"
#include "depth_files.h"
#include "extraction_options.h"
#include "node_maps.h"
#include "skeleton_output.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/io/map_file.h"
#include "zskel/io/output_file.h"
#include "zskel/io/picture.h"
#include "zskel/io/skeleton_json.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    SkeletonOutput output;
    std::string correspondence;
    bool stats = false;
    bool strict = false;
    std::string picture;
    std::string picture_paths;
    PictureOptions picture_options;
    std::string depth_folder;
    std::vector<std::uint32_t> depth_vertices;
    std::string maps;
    int map_px = kDefaultMapPx;
    JsonParts parts;
    ExtractionOptions how;
};

// One line that is drawn over itself; on a terminal only.
class ProgressBar {
  public:
    explicit ProgressBar(bool wanted) : shown_(wanted && ::isatty(STDERR_FILENO) == 1) {}
    ~ProgressBar() {
        if (drawn_) std::fputs("\r\033[K", stderr);
    }
    bool show(std::string_view stage, double share) {
        if (!shown_) return true;
        const std::string line =
            fmt::format("\r\033[K{:<8} {:3.0f} % [{:<40}]", stage, share * 100,
                        std::string(static_cast<std::size_t>(share * 40), '#'));
        std::fputs(line.c_str(), stderr);
        drawn_ = true;
        return true;
    }

  private:
    bool shown_;
    bool drawn_ = false;
};

// A row of the paper's Table 1, with our own evaluations beside it.
std::string stats_text(const std::string& model, const ExtractResult& result) {
    const ExtractStatistics& s = result.statistics;
    return fmt::format(
        "{:<20} {:>8} {:>8} {:>10} {:>10} {:>10} {:>12}\n{:<20} {:>8} {:>8} {:>10.2f} {:>10} "
        "{:>10} {:>12}\n",
        "Model", "Faces", "Vertices", "Seconds", "Nodes", "Edges", "Evaluations",
        model.substr(model.find_last_of('/') + 1), s.faces, s.vertices, s.seconds(),
        result.graph.nodes.size(), result.graph.edges.size(), s.evaluations);
}

void write_results(const Arguments& arguments, SkeletonFormat format, const Mesh& mesh,
                   const ExtractResult& result, const Provenance& provenance) {
    if (!arguments.correspondence.empty()) {
        write_output_text(arguments.correspondence,
                          write_correspondence(result.graph, mesh.positions));
    }
    write_output_text(
        arguments.output.path,
        format == SkeletonFormat::Json
            ? skeleton_json(result, provenance, arguments.parts)
            : write_skeleton(result.graph, format, {arguments.output.tubes, provenance.command}));
}

void draw_pictures(const Arguments& arguments, const ExtractResult& result, gl::Context& context) {
    const std::string title = fmt::format("zskel: {}", arguments.model);
    if (!arguments.picture.empty()) {
        write_png(arguments.picture,
                  draw_skeleton(context, result.surface, result.graph, arguments.picture_options),
                  title);
    }
    if (arguments.picture_paths.empty()) return;
    const Similarity& world = result.surface.world_from_model;
    std::vector<std::vector<Vec3>> paths;
    for (const SeedReport& seed : result.seeds) {
        std::vector<Vec3>& path = paths.emplace_back();
        for (const DVec3& p : seed.path) path.push_back(world.to_world(p));
    }
    std::vector<Vec3> nodes;
    for (const SkeletonGraph::Node& node : result.graph.nodes)
        nodes.push_back(world.to_world(node.position));
    write_png(arguments.picture_paths,
              draw_paths(context, result.surface, paths, nodes, arguments.picture_options), title);
}

// The path of a file as the folder of another has it.
std::string seen_from(const std::string& other, const std::string& path) {
    if (other == "-") return path;
    return std::filesystem::proximate(path, std::filesystem::absolute(other).parent_path())
        .generic_string();
}

ExitCode extract(const Arguments& given, const Common& common) {
    check_method_options(given.how);
    Arguments arguments = given;
    arguments.how.extract.paper.steps.keep_paths =
        arguments.parts.paths || !arguments.picture_paths.empty();
    const SkeletonFormat format = format_of(arguments.output);
    if ((arguments.parts.seeds || arguments.parts.paths) && format != SkeletonFormat::Json) {
        throw UsageError(fmt::format("--with-seeds and --with-paths go with json, not with {}",
                                     info_of(format).name));
    }
    check_outputs(arguments.model, {arguments.output.path, arguments.correspondence, arguments.maps,
                                    arguments.picture, arguments.picture_paths});
    check_extension(arguments.picture, ".png");
    check_extension(arguments.picture_paths, ".png");
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    // A picture that cannot be drawn is known before the work starts, not after.
    std::unique_ptr<gl::Context> picture_context;
    if (!arguments.picture.empty() || !arguments.picture_paths.empty())
        picture_context = open_picture_context();
    arguments.how.backend = backend_options_for(mesh, arguments.how.extract, arguments.how.backend);
    const std::unique_ptr<Backend> backend = open_backend(arguments.how.backend);
    ExtractResult result;
    {
        ProgressBar bar(common.verbosity >= 0 && common.log_format == "text");
        arguments.how.extract.progress = [&](std::string_view stage, double share) {
            return bar.show(stage, share);
        };
        result = extract_skeleton(mesh, arguments.how.extract, *backend);
    }
    const Provenance provenance{arguments.model,       mesh.hash,
                                common.command,        arguments.how.extract,
                                arguments.how.backend, backend->info()};
    if (!arguments.depth_folder.empty()) {
        write_trajectories(arguments.depth_folder, arguments.depth_vertices, mesh,
                           arguments.how.extract, *backend);
    }
    if (picture_context) draw_pictures(arguments, result, *picture_context);
    if (!arguments.maps.empty()) {
        const VisibilityMaps maps =
            maps_of(mesh, result.graph, arguments.how.backend, arguments.map_px);
        write_output_text(arguments.maps, write_visibility_maps(maps));
        arguments.parts.maps = seen_from(arguments.output.path, arguments.maps);
    }
    write_results(arguments, format, mesh, result, provenance);
    log_info("{} nodes, {} edges; {} evaluations of {} seeds in {:.2f} s by {}",
             result.graph.nodes.size(), result.graph.edges.size(), result.statistics.evaluations,
             result.statistics.seeds, result.statistics.seconds(), backend->info().name);
    if (arguments.stats) std::fputs(stats_text(arguments.model, result).c_str(), stderr);
    return arguments.strict && !result.check.failures.empty() ? ExitCode::Check : ExitCode::Ok;
}

// What the paper's method alone can write.
void add_dump_options(CLI::App& command, Arguments& arguments) {
    CLI::Option* folder =
        command
            .add_option("--dump-depth", arguments.depth_folder,
                        "Write the cube maps along seeds' paths into this folder (EXR)")
            ->group(kPaperGroup);
    CLI::Option* vertices =
        command
            .add_option(
                "--dump-vertices", arguments.depth_vertices,
                "Of the seeds of these input vertices, V,V,...; by default of eight spread evenly")
            ->delimiter(',')
            ->needs(folder)
            ->group(kPaperGroup);
    arguments.how.paper_only.insert(arguments.how.paper_only.end(), {folder, vertices});
}

}  // namespace

void add_extract_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("extract", "Extract the curve skeleton of a mesh");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    add_output_options(*command, arguments->output);
    command->add_option("--correspondence", arguments->correspondence,
                        "Write a segment from each vertex's node to the vertex too, as CGAL does "
                        "beside its polylines (.polylines.txt)");
    add_extraction_options(*command, arguments->how);
    add_dump_options(*command, *arguments);
    CLI::Option* maps = command->add_option(
        "--keep-maps", arguments->maps,
        "Write what every node sees into this file: zskel reconstruct rebuilds the "
        "surface of it");
    add_map_px_option(*command, arguments->map_px)->needs(maps);
    command->add_flag("--with-seeds", arguments->parts.seeds,
                      "Add every seed's start, end, state and steps to the JSON");
    command->add_flag("--with-paths", arguments->parts.paths, "Add every seed's path too");
    command->add_flag("--stats", arguments->stats,
                      "Print a row of the paper's Table 1 to standard error");
    command->add_flag("--strict", arguments->strict,
                      "Exit with 6 when the skeleton fails its self-check (components, cycles, "
                      "inside); it is written all the same");
    CLI::Option* picture = command->add_option("--picture", arguments->picture,
                                               "Draw the skeleton in the translucent model (PNG)");
    CLI::Option* paths =
        command->add_option("--picture-paths", arguments->picture_paths,
                            "Draw the seeds' paths and the nodes (PNG; the paper's Figure 3)");
    add_picture_options(*command, arguments->picture_options, {picture, paths});
    command->footer(
        "Examples:\n  zskel extract horse.obj -o horse.json --picture horse.png\n"
        "  zskel extract horse.obj --method paper --backend ray --rays 197 --stats -o horse.json\n"
        "  zskel extract horse.obj -o horse.polylines.txt --correspondence "
        "horse.correspondence.polylines.txt\n"
        "  zskel extract horse.obj --node-link -o horse.json\n"
        "  cat scan.ply | zskel extract - --detail 2 --format obj > scan.skeleton.obj");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return extract(*arguments, common); };
    });
}

}  // namespace zskel::cli
