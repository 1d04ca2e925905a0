// zskel rig: a mesh in, the mesh bound to bones out.
#include <fmt/format.h>

#include "command.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/io/output_file.h"
#include "zskel/io/rig_glb.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    ExtractOptions extract;
    ArmatureOptions armature;
    WeightOptions weights;
    BackendOptions backend;
};

void say_what_was_left_out(const Armature& armature) {
    for (const LoopCut& cut : armature.cuts) {
        log_warning(
            "a loop is open at ({:.6g}, {:.6g}, {:.6g}), between {} and {}: bones form trees",
            cut.position.x, cut.position.y, cut.position.z, armature.bones[cut.bone].name,
            armature.bones[cut.other].name);
    }
    if (armature.dropped_branches > 0) {
        log_warning("{} branches have no bone of their own, to keep within --max-bones",
                    armature.dropped_branches);
    }
}

ExitCode rig(const Arguments& arguments, const Common& common) {
    check_outputs(arguments.model, {arguments.output});
    const Mesh mesh = read_mesh(arguments.model);
    const std::unique_ptr<Backend> backend =
        open_backend(backend_options_for(mesh, arguments.extract, arguments.backend));
    const ExtractResult result = extract_skeleton(mesh, arguments.extract, *backend);
    const Armature armature = build_armature(result.graph, arguments.armature);
    say_what_was_left_out(armature);
    const std::vector<std::vector<Influence>> weights =
        skin_weights(mesh, result.graph, armature, arguments.weights);
    write_output_text(arguments.output, write_rig_glb(mesh, armature, weights, common.command));
    log_info("{} bones of {} branches, {} roots", armature.bones.size(),
             find_branches(result.graph).size(), armature.roots.size());
    return ExitCode::Ok;
}

}  // namespace

void add_rig_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("rig", "Bind a mesh to the bones of its skeleton (GLB)");
    auto arguments = std::make_shared<Arguments>();
    command->add_option("model", arguments->model, "OBJ, OFF, PLY or STL; - reads standard input")
        ->required();
    command->add_option("-o,--output", arguments->output, "GLB file; - writes standard output")
        ->required();
    command
        ->add_option("--max-bones", arguments->armature.max_bones,
                     "At most this many bones: they get coarser first, then the shortest end "
                     "branches get none of their own; 0: as many as the shape needs")
        ->capture_default_str()
        ->check(CLI::Range(0, 60000));
    command
        ->add_option("--detail", arguments->extract.newton.limbs.detail,
                     "How far a limb must stick out to have bones: below 1 more of them, above 1 "
                     "fewer")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 100.0));
    command
        ->add_option("--smoothing", arguments->weights.smoothing_radii,
                     "How far a bone's hold fades out over the surface, in radii of the limb")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 10.0));
    add_backend_options(*command, arguments->backend);
    command->footer(
        "Examples:\n  zskel rig horse.obj -o horse.glb\n"
        "  zskel rig scan.ply --max-bones 40 --detail 2 -o scan.glb");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return rig(*arguments, common); };
    });
}

}  // namespace zskel::cli
