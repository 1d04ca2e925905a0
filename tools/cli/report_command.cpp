// zskel report: a mesh in, a page about its skeleton out.
#include "command.h"
#include "node_maps.h"
#include "zskel/core/log.h"
#include "zskel/extract.h"
#include "zskel/io/html_report.h"
#include "zskel/io/output_file.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    int map_px = kDefaultMapPx;
    ExtractOptions extract;
    BackendOptions backend;
};

ExitCode report(const Arguments& arguments, const Common& common) {
    if (!has_html_report())
        throw UsageError("this zskel was built without three.js: run tools/setup, build again");
    check_outputs(arguments.model, {arguments.output});
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    const BackendOptions options = backend_options_for(mesh, arguments.extract, arguments.backend);
    const std::unique_ptr<Backend> backend = open_backend(options);
    const ExtractResult result = extract_skeleton(mesh, arguments.extract, *backend);
    const Provenance provenance{arguments.model,   mesh.hash, common.command,
                                arguments.extract, options,   backend->info()};
    const VisibilityMaps maps = maps_of(mesh, result.graph, options, arguments.map_px);
    write_output_text(arguments.output, html_report(result, provenance, maps));
    return ExitCode::Ok;
}

}  // namespace

void add_report_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand(
        "report", "Write a page about a model's skeleton that any browser shows (HTML)");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command
        ->add_option("-o,--output", arguments->output,
                     "HTML file, which needs nothing beside it; - writes standard output")
        ->required();
    command
        ->add_option(
            "--detail", arguments->extract.newton.limbs.detail,
            "How far a limb must stick out to be kept: below 1 more of them, above 1 fewer")
        ->capture_default_str()
        ->check(number_in(0.01, 100.0));
    add_map_px_option(*command, arguments->map_px);
    add_backend_options(*command, arguments->backend);
    command->footer("Example:\n  zskel report horse.obj -o horse.html");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return report(*arguments, common); };
    });
}

}  // namespace zskel::cli
