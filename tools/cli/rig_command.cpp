// zskel rig: a mesh in, the mesh bound to bones out.
#include <algorithm>
#include <cmath>

#include "command.h"
#include "rig_model.h"
#include "zskel/core/log.h"
#include "zskel/io/output_file.h"
#include "zskel/io/picture.h"
#include "zskel/io/png.h"
#include "zskel/io/rig_glb.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/surface.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    std::string picture;
    PictureOptions picture_options;
    RigOptions rig;
};

// The bones as a graph: a node at every joint and tail, an edge along every bone, and one to it
// from the tail of what it hangs on.
SkeletonGraph graph_of(const Armature& armature) {
    SkeletonGraph graph;
    const auto add = [&](const DVec3& position, std::uint32_t from) {
        if (from != kNone && graph.nodes[from].position == position) return from;
        const auto number = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.push_back({.position = position});
        if (from != kNone) graph.edges.push_back({.source = from, .target = number});
        return number;
    };
    std::vector<std::uint32_t> tails;  // of every bone
    for (const Bone& bone : armature.bones) {
        const std::uint32_t from = bone.parent == kNone ? kNone : tails[bone.parent];
        tails.push_back(add(bone.tail, add(joint_of(bone), from)));
    }
    return graph;
}

// Told apart from those beside it: hues by steps of the golden ratio.
Vec3 color_of_bone(std::size_t bone) {
    const double hue = 6.0 * std::fmod(0.618033988749895 * static_cast<double>(bone), 1.0);
    const auto part = [&](double shift) {
        const double h = std::fmod(hue + shift, 6.0);
        return static_cast<float>(0.35 + 0.6 * std::clamp(std::abs(h - 3.0) - 1.0, 0.0, 1.0));
    };
    return {part(0.0), part(4.0), part(2.0)};
}

// Every vertex in the colours of its bones, by their weights.
void draw_weights(const Arguments& arguments, const Mesh& mesh, const RiggedModel& rig,
                  gl::Context& context, const Common& common) {
    const PreparedSurface prepared = prepare_surface(mesh);
    std::vector<Vec3> tints;
    for (const std::uint32_t v : prepared.input_vertex) {
        Vec3 tint(0.0f);
        for (const Influence& influence : rig.weights[v])
            tint += influence.weight * color_of_bone(influence.bone);
        tints.push_back(tint);
    }
    const Image image = draw_skeleton(context, prepared.surface, graph_of(rig.armature),
                                      arguments.picture_options, tints);
    write_output_text(arguments.picture, encode_png(image, common.command));
}

ExitCode rig(const Arguments& arguments, const Common& common) {
    check_outputs(arguments.model, {arguments.output, arguments.picture});
    check_extension(arguments.output, ".glb");
    check_extension(arguments.picture, ".png");
    std::unique_ptr<gl::Context> picture_context;
    if (!arguments.picture.empty()) picture_context = open_picture_context();
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    const RiggedModel rig = rig_model(mesh, arguments.rig);
    write_output_text(arguments.output,
                      write_rig_glb(mesh, rig.armature, rig.weights, {}, common.command));
    if (picture_context) draw_weights(arguments, mesh, rig, *picture_context, common);
    log_info("{} bones of {} branches", rig.armature.bones.size(), find_branches(rig.graph).size());
    return ExitCode::Ok;
}

}  // namespace

void add_rig_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("rig", "Bind a mesh to the bones of its skeleton (GLB)");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command->add_option("-o,--output", arguments->output, "GLB file; - writes standard output")
        ->required();
    CLI::Option* picture =
        command->add_option("--picture", arguments->picture,
                            "Draw the bones in the model, every vertex in the colours of its bones "
                            "(PNG)");
    add_picture_options(*command, arguments->picture_options, {picture});
    add_rig_options(*command, arguments->rig);
    command->footer(
        "Examples:\n  zskel rig horse.obj -o horse.glb --picture horse_bones.png\n"
        "  zskel rig scan.ply --max-bones 40 --detail 2 -o scan.glb");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return rig(*arguments, common); };
    });
}

}  // namespace zskel::cli
