// zskel repair: the surface that extract would work on, as a model.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "extraction_options.h"
#include "zskel/io/output_file.h"
#include "zskel/io/write_mesh.h"
#include "zskel/mesh/surface.h"

namespace zskel::cli {
namespace {

struct Arguments {
    std::string model;
    std::string output;
    ExtractOptions extract;
    bool keeps_caps = false;
    bool as_json = false;
};

constexpr const char* kCapped = "openings closed with caps";  // and more, where they are left out

struct Mended {
    std::vector<DVec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Repair> repairs;
};

Mended mend(const Mesh& mesh, const Arguments& arguments) {
    if (arguments.extract.join) {
        JoinedMesh joined = join_parts(mesh, arguments.extract.repair, *arguments.extract.join);
        return {std::move(joined.mesh.positions), std::move(joined.mesh.triangles),
                std::move(joined.repairs)};
    }
    PreparedSurface prepared = prepare_surface(mesh, WorldSize::UnitCube, arguments.extract.repair);
    Mended out{{}, {}, std::move(prepared.repairs)};
    for (Repair& repair : out.repairs) {
        if (arguments.keeps_caps && repair.what.starts_with(kCapped)) repair.what = kCapped;
    }
    for (const std::uint32_t v : prepared.input_vertex) out.positions.push_back(mesh.positions[v]);
    for (const auto& [v, place] : prepared.put_in) out.positions[v] = place;
    for (std::size_t t = 0; t < prepared.surface.triangles.size(); ++t) {
        if (prepared.input_triangle[t] != kNone || arguments.keeps_caps)
            out.triangles.push_back(prepared.surface.triangles[t]);
    }
    return out;
}

ExitCode repair(const Arguments& arguments, const Common& common) {
    check_outputs(arguments.model, {arguments.output});
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    const Mended mended = mend(mesh, arguments);
    write_output_text(arguments.output, write_mesh_as(arguments.output, mended.positions,
                                                      mended.triangles, common.command));
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::string text;
    for (const Repair& repair : mended.repairs) {
        list.push_back({{"what", repair.what}, {"count", repair.count}});
        text += fmt::format("{}: {}\n", repair.what, repair.count);
    }
    if (arguments.output == "-") return ExitCode::Ok;
    const nlohmann::ordered_json all{{"model", arguments.model},
                                     {"output", arguments.output},
                                     {"vertices", mended.positions.size()},
                                     {"triangles", mended.triangles.size()},
                                     {"repairs", list}};
    print(arguments.as_json ? all.dump(2) + "\n" : text.empty() ? "nothing to repair\n" : text);
    return ExitCode::Ok;
}

}  // namespace

void add_repair_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand(
        "repair", "Write the surface that extract would work on, and say what was mended");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command
        ->add_option("-o,--output", arguments->output,
                     "Where it goes: .obj or .ply; - writes OBJ to standard output")
        ->required();
    CLI::Option* caps =
        command->add_flag("--caps", arguments->keeps_caps,
                          "Write the caps on openings too: the surface is then closed");
    command->add_flag("--json", arguments->as_json, "Print JSON");
    add_repair_options(*command, arguments->extract);
    caps->excludes(command->get_option("--no-caps"));
    command->footer(
        "Examples:\n  zskel repair scan.ply -o clean.ply\n  zskel repair scan.ply -o clean.obj -v");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return repair(*arguments, common); };
    });
}

}  // namespace zskel::cli
