// zskel depth: the cube map of one eye, as an EXR to compute with or a PNG to look at.
#include <fmt/format.h>

#include <array>

#include "command.h"
#include "depth_files.h"
#include "zskel/depth_probe.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    std::vector<double> at;
    std::int64_t vertex = -1;
    int step = 0;
    ExtractOptions extract;
    BackendOptions backend;
};

DepthDump look(const Arguments& arguments, DepthProbe& probe) {
    if (!arguments.at.empty())
        return probe.at_point({arguments.at[0], arguments.at[1], arguments.at[2]});
    const auto path =
        probe.along_path(static_cast<std::uint32_t>(arguments.vertex), arguments.extract);
    const int last = static_cast<int>(path.size()) - 1;
    if (arguments.step > last) {
        throw UsageError(fmt::format("vertex {} comes to rest after {} steps; there is no step {}",
                                     arguments.vertex, last, arguments.step));
    }
    return path[static_cast<std::size_t>(arguments.step < 0 ? last : arguments.step)];
}

ExitCode depth(const Arguments& arguments, const Common& common) {
    if (arguments.at.empty() == (arguments.vertex < 0))
        throw UsageError("give either --at X,Y,Z or --vertex V");
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    const auto backend = open_backend(arguments.backend);
    DepthProbe probe(mesh, *backend);
    write_depth_file(arguments.output, look(arguments, probe));
    return ExitCode::Ok;
}

}  // namespace

void add_depth_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command =
        app.add_subcommand("depth", "Write the cube map that one eye sees: EXR, or PNG to look at");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command->add_option("-o,--output", arguments->output, "map.exr or map.png")->required();
    auto* at =
        command->add_option("--at", arguments->at, "The eye, in the model's coordinates: X,Y,Z")
            ->delimiter(',')
            ->expected(3);
    auto* vertex = command
                       ->add_option("--vertex", arguments->vertex,
                                    "The eye is the seed of this input vertex (from 0)")
                       ->check(CLI::Range(std::int64_t{0}, std::int64_t{0xFFFFFFFE}))
                       ->excludes(at);
    command
        ->add_option("--step", arguments->step,
                     "After this many steps of the paper's method; -1: at rest")
        ->capture_default_str()
        ->check(CLI::Range(-1, 1 << 30))
        ->needs(vertex);
    add_backend_options(*command, arguments->backend);
    command->footer(
        "Examples:\n  zskel depth horse.obj --vertex 12 --step -1 -o rest.png\n"
        "  zskel depth horse.obj --at 0,0.1,0 --face-px 128 -o inside.exr");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return depth(*arguments, common); };
    });
}

}  // namespace zskel::cli
