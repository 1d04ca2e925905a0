// zskel deform: a mesh and a pose in, the mesh in that pose out (the paper's Figure 5).
#include <fmt/format.h>

#include <cstdio>

#include "command.h"
#include "rig_model.h"
#include "zskel/core/input_file.h"
#include "zskel/io/output_file.h"
#include "zskel/io/write_mesh.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/rig/skinning.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string pose;
    std::string output;
    RigOptions rig;
    Skinning skinning = Skinning::DualQuaternion;
};

std::string measures_text(const Mesh& mesh, const DeformMeasures& m) {
    return fmt::format(
        "volume          {}\nflipped faces   {} of {}\nedge stretch    median {:.4f}, at "
        "99 % of the edges {:.3f}, worst {:.2f}\nfarthest moved  {:.4f} of the diagonal\n",
        m.volume_change ? fmt::format("{:+.3f} %", 100.0 * *m.volume_change)
                        : "none: the surface is open",
        m.flipped_faces, mesh.triangles.size(), m.edge_stretch_median, m.edge_stretch_p99,
        m.edge_stretch_worst, m.farthest);
}

ExitCode deform_model(const Arguments& arguments, const Common& common) {
    if (arguments.model == "-" && arguments.pose == "-")
        throw UsageError("the model and the pose cannot both come from standard input");
    check_outputs(arguments.model, {arguments.output});
    check_outputs(arguments.pose, {arguments.output});
    const std::string pose_text = read_input_file(arguments.pose, "a pose (JSON)");
    const Mesh mesh = read_mesh(arguments.model);
    const RiggedModel rig = rig_model(mesh, arguments.rig);
    const Pose pose = read_pose(pose_text, arguments.pose, rig.armature);
    const std::vector<BoneMotion> motions = bone_motions(rig.armature, pose);
    const std::vector<DVec3> deformed =
        deform(mesh, rig.armature, rig.weights, motions, arguments.skinning);
    write_output_text(arguments.output, write_obj_mesh(deformed, mesh.triangles, common.command));
    if (common.verbosity >= 0) {
        const std::string text =
            measures_text(mesh, measure_deformation(mesh, deformed, rig.weights, motions));
        std::fputs(text.c_str(), stderr);
    }
    return ExitCode::Ok;
}

}  // namespace

void add_deform_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("deform", "Pose a mesh by the branches of its skeleton");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command
        ->add_option(
            "--pose", arguments->pose,
            "JSON: {\"moves\": [{\"branch\": 3, \"bend\": 90, \"axis\": [0, 0, 1]}, ...]}; "
            "branch: its number in the skeleton's JSON, or bone: a name, or near: a "
            "point; turn, bend and twist in degrees, stretch as a factor")
        ->required();
    command->add_option("-o,--output", arguments->output, "OBJ file; - writes standard output")
        ->required();
    command
        ->add_option_function<std::string>(
            "--skinning",
            [arguments](const std::string& name) {
                arguments->skinning =
                    name == "linear" ? Skinning::Linear : Skinning::DualQuaternion;
            },
            "dual: dual quaternions, which keep a bent limb's girth; linear: as most engines "
            "[dual]")
        ->check(CLI::IsMember({"dual", "linear"}));
    add_rig_options(*command, arguments->rig);
    command->footer("Example:\n  zskel deform hand.obj --pose fist.json -o fist.obj");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return deform_model(*arguments, common); };
    });
}

}  // namespace zskel::cli
