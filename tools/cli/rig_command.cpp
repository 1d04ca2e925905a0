// zskel rig: a mesh in, the mesh bound to bones out.
#include "command.h"
#include "rig_model.h"
#include "zskel/core/log.h"
#include "zskel/io/output_file.h"
#include "zskel/io/rig_glb.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    RigOptions rig;
};

ExitCode rig(const Arguments& arguments, const Common& common) {
    check_outputs(arguments.model, {arguments.output});
    check_extension(arguments.output, ".glb");
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    const RiggedModel rig = rig_model(mesh, arguments.rig);
    write_output_text(arguments.output,
                      write_rig_glb(mesh, rig.armature, rig.weights, {}, common.command));
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
    add_rig_options(*command, arguments->rig);
    command->footer(
        "Examples:\n  zskel rig horse.obj -o horse.glb\n"
        "  zskel rig scan.ply --max-bones 40 --detail 2 -o scan.glb");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return rig(*arguments, common); };
    });
}

}  // namespace zskel::cli
