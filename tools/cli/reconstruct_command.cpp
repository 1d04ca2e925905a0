// zskel reconstruct: the surface recalled from what the skeleton's nodes see (the paper's section
// 6).
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "command.h"
#include "node_maps.h"
#include "zskel/core/input_file.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/io/json_place.h"
#include "zskel/io/map_file.h"
#include "zskel/io/output_file.h"
#include "zskel/io/skeleton_formats.h"
#include "zskel/io/write_mesh.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/make_mesh.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/rebuild/fidelity.h"
#include "zskel/rebuild/watertight.h"

namespace zskel::cli {
namespace {

constexpr double kSeenWithin = 0.003;  // of the diagonal
constexpr double kSamePlace = 1e-5;    // of the diagonal
constexpr double kLeastSeen = 0.5;     // of a model that the maps are of
constexpr std::array<int, 4> kTableSizes = {8, 16, 32, 64};
constexpr std::array<std::size_t, 3> kTableThinnings = {1, 2, 4};

struct Arguments {
    std::string input;
    std::string output;
    std::string points;
    std::string original;
    std::string picture;
    PictureOptions picture_options;
    int map_px = kDefaultMapPx;
    bool has_map_px = false;  // given on the line
    RebuildOptions rebuild;
    bool table = false;
    bool as_json = false;
    ExtractOptions extract;
    BackendOptions backend;
};

// The file that a skeleton's JSON names, which lies where that says.
std::string maps_file_of(const std::string& path) {
    const nlohmann::json data = parse_json(read_input_file(path, "a skeleton (JSON)").text(), path);
    const JsonPlace place(data, path);
    if (!place.has("visibility_maps")) {
        throw InputError(fmt::format(
            "{}: names no visibility maps; zskel extract --keep-maps FILE writes them", path));
    }
    const JsonPlace maps = place.at("visibility_maps");
    if (!maps.value().is_string()) maps.fail("a file's name");
    return std::filesystem::path(path).parent_path() / maps.value().get<std::string>();
}

// A skeleton's maps lie at its nodes.
void check_maps_of(const SkeletonGraph& graph, const VisibilityMaps& maps,
                   const std::string& file) {
    std::vector<DVec3> eyes;
    for (const NodeMap& map : maps.nodes) eyes.push_back(map.eye);
    const double tolerance = kSamePlace * box_of(eyes).diagonal();
    bool is_same = maps.nodes.size() == graph.nodes.size();
    for (std::size_t n = 0; is_same && n < eyes.size(); ++n)
        is_same = glm::distance(eyes[n], graph.nodes[n].position) <= tolerance;
    if (!is_same) throw InputError(fmt::format("{}: the maps of another skeleton", file));
}

// Ends and junctions, and of the nodes between them every so many.
VisibilityMaps thinned(const VisibilityMaps& maps, const SkeletonGraph& graph, std::size_t every) {
    VisibilityMaps out;
    out.face_px = maps.face_px;
    std::vector<bool> is_kept(graph.nodes.size(), false);
    for (const Branch& branch : find_branches(graph)) {
        for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
            if (i % every == 0 || i + 1 == branch.nodes.size()) is_kept[branch.nodes[i]] = true;
        }
    }
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::size_t n = 0; n < is_kept.size(); ++n) {
        if (is_kept[n] || degrees[n] == 0) out.nodes.push_back(maps.nodes[n]);
    }
    return out;
}

// What is known of a surface that was rebuilt, beside the one that was seen.
struct Row {
    int map_px = 0;
    std::size_t nodes = 0;
    double voxel = 0.0;
    std::size_t faces = 0;
    double seen = 0.0;
    double mean = 0.0;  // of the diagonal
    double hausdorff = 0.0;
};

Mesh mesh_of(const RebuiltMesh& rebuilt) {
    Mesh mesh;
    mesh.name = "the rebuilt surface";
    mesh.positions = rebuilt.positions;
    mesh.triangles = rebuilt.triangles;
    return mesh;
}

Row measure(const Mesh& original, const VisibilityMaps& maps, const RebuiltMesh& rebuilt) {
    const double diagonal = box_of(original.positions).diagonal();
    const SurfaceDistances distances = distances_between(original, mesh_of(rebuilt));
    return {maps.face_px,
            maps.nodes.size(),
            rebuilt.voxel / diagonal,
            rebuilt.triangles.size(),
            share_seen(original, maps, kSeenWithin * diagonal),
            distances.mean / diagonal,
            distances.hausdorff / diagonal};
}

std::string text_of(const std::vector<Row>& rows) {
    std::string out = fmt::format("{:>6} {:>6} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "texels", "nodes",
                                  "voxel %", "faces", "seen %", "mean %", "hausdorff %");
    for (const Row& row : rows) {
        out += fmt::format("{:>6} {:>6} {:>8.3f} {:>8} {:>8.2f} {:>8.3f} {:>10.2f}\n", row.map_px,
                           row.nodes, 100 * row.voxel, row.faces, 100 * row.seen, 100 * row.mean,
                           100 * row.hausdorff);
    }
    return out;
}

std::string json_of(const std::vector<Row>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        list.push_back({{"map_px", row.map_px},
                        {"nodes", row.nodes},
                        {"voxel_diagonals", row.voxel},
                        {"faces", row.faces},
                        {"share_seen", row.seen},
                        {"mean_distance_diagonals", row.mean},
                        {"hausdorff_diagonals", row.hausdorff}});
    }
    return list.dump(1) + "\n";
}

// The original, every vertex the more orange the farther the rebuilt surface is from it, and blue
// where no node sees it; the nodes inside.
void draw_coverage(const Arguments& arguments, const Mesh& original, const VisibilityMaps& maps,
                   const RebuiltMesh& rebuilt, gl::Context& context, const Common& common) {
    const PreparedSurface prepared = prepare_surface(original);
    std::vector<DVec3> places;
    for (const Vec3& p : prepared.surface.positions)
        places.push_back(prepared.surface.world_from_model.to_model(p));
    const double limit = kSeenWithin * box_of(original.positions).diagonal();
    const std::vector<char> is_seen = are_seen(places, maps, limit);
    const std::vector<double> distances = distances_to(mesh_of(rebuilt), places);
    std::vector<Vec3> tints;
    for (std::size_t v = 0; v < places.size(); ++v) {
        const auto off = static_cast<float>(std::min(distances[v] / limit, 1.0));
        tints.push_back(is_seen[v] ? glm::mix(kModelColor, kEndColor, off) : kJunctionColor);
    }
    SkeletonGraph nodes;
    for (const NodeMap& map : maps.nodes) nodes.nodes.push_back({.position = map.eye});
    const Image image =
        draw_skeleton(context, prepared.surface, nodes, arguments.picture_options, tints);
    write_output_text(arguments.picture, encode_png(image, common.command));
}

ExitCode reconstruct(const Arguments& arguments, const Common& common) {
    if (arguments.output.empty() && !arguments.table)
        throw UsageError("give --output, or --table for measures alone");
    const bool from_json = is_skeleton_json(arguments.input);
    const bool from_maps = from_json || arguments.input.ends_with(".maps");
    if (arguments.table && from_maps)
        throw UsageError("--table needs the model itself: it looks again with other maps");
    check_outputs(arguments.input, {arguments.output, arguments.points, arguments.picture});
    check_extension(arguments.picture, ".png");
    std::unique_ptr<gl::Context> picture_context;
    if (!arguments.picture.empty()) {
        if (arguments.output.empty()) throw UsageError("--picture goes with --output");
        if (from_maps && arguments.original.empty())
            throw UsageError("--picture shows the model: with maps, give --original");
        picture_context = open_picture_context();
    }
    std::optional<Mesh> original;
    VisibilityMaps maps;
    SkeletonGraph graph;
    BackendOptions backend = arguments.backend;
    if (from_maps) {
        const std::string file = from_json ? maps_file_of(arguments.input) : arguments.input;
        if (arguments.has_map_px)
            throw UsageError("--map-px goes with a model; maps have the texels that they have");
        maps = read_visibility_maps(read_input_file(file, "visibility maps").text(), file);
        if (from_json) check_maps_of(read_skeleton(arguments.input).graph, maps, file);
        if (!arguments.original.empty()) original = read_mesh(arguments.original, common.reading);
    } else {
        if (!arguments.original.empty())
            throw UsageError("--original goes with maps; here the model is at hand");
        original = read_mesh(arguments.input, common.reading);
        backend = backend_options_for(*original, arguments.extract, backend);
        graph = extract_skeleton(*original, arguments.extract, *open_backend(backend)).graph;
        maps = maps_of(*original, graph, backend, arguments.map_px);
    }
    std::vector<Row> rows;
    if (!arguments.output.empty()) {
        const RebuiltMesh rebuilt = rebuild_surface(maps, arguments.rebuild);
        if (rebuilt.triangles.empty()) {
            throw UsageError(fmt::format("--voxel {}: no surface is left at that size",
                                         arguments.rebuild.voxel_model));
        }
        if (!arguments.points.empty()) {
            std::vector<DVec3> positions;
            std::vector<DVec3> normals;
            for (const Surfel& s : merge_surfels(Recall(maps).surfels(), rebuilt.voxel)) {
                positions.push_back(s.position);
                normals.push_back(s.normal);
            }
            write_output_text(arguments.points,
                              write_ply_points(positions, normals, common.command));
        }
        write_output_text(arguments.output, write_mesh_as(arguments.output, rebuilt.positions,
                                                          rebuilt.triangles, common.command));
        if (picture_context)
            draw_coverage(arguments, *original, maps, rebuilt, *picture_context, common);
        if (original && !arguments.table) {
            rows.push_back(measure(*original, maps, rebuilt));
            if (rows.back().seen < kLeastSeen) {
                log_warning("{}: the maps see {:.1f} % of it: are they of another model?",
                            original->name, 100.0 * rows.back().seen);
            }
        }
    }
    if (arguments.table) {
        for (const int px : kTableSizes) {
            const VisibilityMaps all = maps_of(*original, graph, backend, px);
            for (const std::size_t every : kTableThinnings) {
                const VisibilityMaps some = thinned(all, graph, every);
                rows.push_back(measure(*original, some, rebuild_surface(some, arguments.rebuild)));
            }
        }
    }
    if (arguments.as_json) {
        print(json_of(rows));
    } else if (!rows.empty() && common.verbosity >= 0) {
        const std::string text = text_of(rows);
        std::fputs(text.c_str(), stderr);
    }
    return ExitCode::Ok;
}

}  // namespace

void add_reconstruct_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand(
        "reconstruct", "Rebuild a surface from what the nodes of its skeleton see");
    auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("input", arguments->input,
                     "Visibility maps (.maps), a skeleton that names them (.json), or a model")
        ->required();
    command->add_option("-o,--output", arguments->output, "PLY or OBJ file: a watertight surface");
    command->add_option("--points", arguments->points,
                        "Write the points that the nodes see too, merged, with normals (PLY)");
    add_map_px_option(*command, arguments->map_px);
    command
        ->add_option("--voxel", arguments->rebuild.voxel_model,
                     "Side of the cubes that the surface is sampled in, in the model's units; 0: "
                     "by the thinnest parts")
        ->capture_default_str()
        ->check(length_or_zero());
    command->add_option("--original", arguments->original,
                        "With maps: the model to measure against");
    CLI::Option* picture = command->add_option(
        "--picture", arguments->picture,
        "Draw the model (PNG): orange where the rebuilt surface is 0.3 % of the "
        "diagonal off, blue where no node sees it");
    add_picture_options(*command, arguments->picture_options, {picture});
    command->add_flag("--table", arguments->table,
                      "Measure with maps of 8 to 64 texels, of all nodes and of fewer");
    command->add_flag("--json", arguments->as_json, "Print the measures as JSON");
    add_backend_options(*command, arguments->backend);
    command->footer(
        "Examples:\n  zskel reconstruct horse.obj -o rebuilt.ply\n"
        "  zskel extract horse.obj -o horse.json --keep-maps horse.maps\n"
        "  zskel reconstruct horse.json --original horse.obj -o rebuilt.ply");
    command->callback([&run, &common, command, arguments] {
        arguments->has_map_px = command->count("--map-px") > 0;
        run = [&common, arguments] { return reconstruct(*arguments, common); };
    });
}

}  // namespace zskel::cli
