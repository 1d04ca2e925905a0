// zskel check: what a model is, and what extract would do about its defects.
#include "command.h"
#include "zskel/io/report.h"
#include "zskel/mesh/check.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {

void add_check_command(CLI::App& app, const Common& common, Run& run) {
    struct Arguments {
        std::string model;
        bool as_json = false;
    };
    CLI::App* command =
        app.add_subcommand("check", "Report a model's topology and defects; nothing is changed");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command->add_flag("--json", arguments->as_json, "Print JSON");
    command->footer(
        "Examples:\n  zskel check scan.ply\n  zskel check scan.ply --json > scan.check.json");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] {
            const MeshReport report = check_mesh(read_mesh(arguments->model, common.reading));
            print(arguments->as_json ? to_json(report) : to_text(report));
            return ExitCode::Ok;
        };
    });
}

}  // namespace zskel::cli
