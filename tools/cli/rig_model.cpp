#include "rig_model.h"

#include "zskel/core/log.h"
#include "zskel/rig/joints.h"

namespace zskel::cli {
namespace {

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
    if (armature.stubs > 0) {
        log_warning("{} limbs hardly leave what they hang on, and have no bone of their own",
                    armature.stubs);
    }
}

}  // namespace

void add_rig_options(CLI::App& command, RigOptions& options) {
    command
        .add_option("--max-bones", options.armature.max_bones,
                    "At most this many joints: bones, roots and ends of limbs. Bones get coarser "
                    "first, then the shortest end branches get none; 0: as many as the shape needs")
        ->capture_default_str()
        ->check(CLI::Range(0, 60000));
    command
        .add_option("--detail", options.extract.newton.limbs.detail,
                    "How far a limb must stick out to have bones: below 1 more of them, above 1 "
                    "fewer")
        ->capture_default_str()
        ->check(number_in(0.01, 100.0));
    command
        .add_option("--smoothing", options.weights.smoothing_radii,
                    "How far a bone's hold fades out over the surface, in radii of the limb")
        ->capture_default_str()
        ->check(number_in(0.01, 10.0));
    add_backend_options(command, options.backend);
}

RiggedModel rig_model(const Mesh& mesh, const RigOptions& options) {
    const std::unique_ptr<Backend> backend =
        open_backend(backend_options_for(mesh, options.extract, options.backend));
    ExtractResult result = extract_skeleton(mesh, options.extract, *backend);
    RiggedModel rig;
    rig.armature = build_armature(result.graph, mesh.triangles, options.armature);
    say_what_was_left_out(rig.armature);
    rig.weights = skin_weights(mesh, result.graph, rig.armature, options.weights);
    centre_joints(mesh, rig.weights, rig.armature);
    rig.graph = std::move(result.graph);
    return rig;
}

}  // namespace zskel::cli
