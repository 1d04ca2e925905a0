// zskel convert: a skeleton from one form into another.
#include <fmt/format.h>

#include <optional>

#include "command.h"
#include "skeleton_output.h"
#include "zskel/core/log.h"
#include "zskel/io/output_file.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string input;
    std::string input_format;
    SkeletonOutput output;
    std::optional<double> radius;
};

// No radius is made up: a form that tells radii gets those of the input, or the one that was given.
void settle_radii(const Arguments& arguments, bool are_wanted, SkeletonFile& file) {
    if (file.has_radii && arguments.radius) {
        throw UsageError(
            fmt::format("--radius is for inputs without radii; {} has its own", arguments.input));
    }
    if (file.has_radii && !are_wanted) {
        log_warning("{}: the radii are left out; this form keeps none", arguments.output.path);
    }
    if (file.has_radii || !are_wanted) return;
    if (!arguments.radius) {
        throw UsageError(fmt::format(
            "{}: has no radii, and the output tells them; give --radius R, one for all nodes",
            arguments.input));
    }
    for (SkeletonGraph::Node& node : file.graph.nodes) node.radius = *arguments.radius;
}

ExitCode convert(const Arguments& arguments, const Common& common) {
    const SkeletonFormat to = format_of(arguments.output);
    if (arguments.input == "-" && arguments.input_format.empty())
        throw UsageError("--from is needed: standard input has no extension");
    const SkeletonFormat from = arguments.input_format.empty()
                                    ? skeleton_format_of_path(arguments.input)
                                    : parse_skeleton_format(arguments.input_format);
    check_outputs(arguments.input, {arguments.output.path});
    SkeletonFile file = read_skeleton(arguments.input, from);
    settle_radii(arguments, info_of(to).keeps_radii || arguments.output.tubes, file);
    write_output_text(arguments.output.path,
                      write_skeleton(file.graph, to, {arguments.output.tubes, common.command}));
    log_info("{} nodes, {} edges", file.graph.nodes.size(), file.graph.edges.size());
    return ExitCode::Ok;
}

}  // namespace

void add_convert_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("convert", "Write a skeleton in another form");
    auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("skeleton", arguments->input,
                     "JSON, GraphML, SWC, OBJ lines, PLY edges, VTP or polylines; - reads standard "
                     "input")
        ->required();
    command
        ->add_option("--from", arguments->input_format,
                     "The input's form; by default what its name says")
        ->type_name("NAME");
    add_output_options(*command, arguments->output);
    command
        ->add_option("--radius", arguments->radius,
                     "Of every node, where the input has no radii (OBJ lines, polylines)")
        ->check(length_or_zero());
    command->footer(
        "Examples:\n  zskel convert horse.json -o horse.swc\n"
        "  zskel convert horse.swc --node-link -o horse.json\n"
        "  zskel convert horse.json --tubes -o horse.ply\n"
        "  zskel convert lines.obj --radius 0.1 -o lines.vtp\n"
        "  zskel convert - --from graphml --format glb <horse.graphml >horse.glb");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return convert(*arguments, common); };
    });
}

}  // namespace zskel::cli
