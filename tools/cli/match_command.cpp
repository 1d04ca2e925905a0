// zskel match: shapes compared by their skeletons, one with another or one with a folder of them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "batch/csv.h"
#include "command.h"
#include "zskel/core/input_file.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/extract.h"
#include "zskel/io/dendrogram.h"
#include "zskel/io/output_file.h"
#include "zskel/io/signature_file.h"
#include "zskel/io/skeleton_formats.h"
#include "zskel/match/signature.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> inputs;
    std::string index;
    std::string store;
    std::string query;
    std::size_t neighbours = 10;
    std::string matrix;
    std::string dendrogram;
    bool as_json = false;
    ExtractOptions extract;
    BackendOptions backend;
    ReadOptions reading;
};

using Shape = NamedSignature;

bool is_skeleton(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension();
    return is_skeleton_json(path) || extension == ".graphml" || extension == ".swc" ||
           extension == ".vtp";
}

// A skeleton that was stored, or that of a model.
Shape shape_of(const std::string& path, const Arguments& arguments) {
    if (is_skeleton(path)) {
        const SkeletonFile file = read_skeleton(path);
        if (!file.has_radii)
            throw InputError(path + ": has no radii, which shapes are compared by");
        if (path.ends_with(".swc")) {
            log_warning(
                "{}: this form keeps no volumes; tubes of its radii stand for them, which lie "
                "apart from the volumes of the same shape",
                path);
        }
        return {path, signature_of(file.graph)};
    }
    const Mesh mesh = read_mesh(path, arguments.reading);
    const BackendOptions options = backend_options_for(mesh, arguments.extract, arguments.backend);
    return {path,
            signature_of(extract_skeleton(mesh, arguments.extract, *open_backend(options)).graph)};
}

// The skeletons that lie in a folder, by name.
std::vector<std::string> skeletons_in(const std::string& folder) {
    std::vector<std::string> out;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.is_regular_file() && is_skeleton(entry.path())) out.push_back(entry.path());
    }
    if (error) throw InputError(fmt::format("{}: {}", folder, error.message()));
    if (out.empty()) {
        throw InputError(fmt::format(
            "{}: holds no skeleton (.json, .graphml, .swc, .vtp); zskel extract makes them",
            folder));
    }
    std::sort(out.begin(), out.end());
    return out;
}

// What cannot be read is said, and costs no more than itself.
std::vector<Shape> shapes_in(const std::string& folder, const Arguments& arguments) {
    const std::vector<std::string> paths = skeletons_in(folder);
    std::vector<Shape> found(paths.size());
    std::vector<std::string> problems(paths.size());
    parallel_for(paths.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                found[i] = shape_of(paths[i], arguments);
            } catch (const InputError& error) {
                problems[i] = error.what();
            }
        }
    });
    std::vector<Shape> out;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (problems[i].empty()) {
            out.push_back(std::move(found[i]));
        } else {
            log_warning("left out: {}", problems[i]);
        }
    }
    if (out.empty()) throw InputError(folder + ": none of its skeletons can be compared");
    return out;
}

// A folder of skeletons, or what --store wrote of one.
std::vector<Shape> indexed_shapes(const Arguments& arguments) {
    if (std::filesystem::is_regular_file(arguments.index))
        return read_signatures(read_input_file(arguments.index, "an index of shapes").text(),
                               arguments.index);
    return shapes_in(arguments.index, arguments);
}

std::vector<std::vector<double>> distances_of(const std::vector<Shape>& shapes) {
    std::vector<std::vector<double>> out(shapes.size(), std::vector<double>(shapes.size(), 0.0));
    parallel_for(shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t a = begin; a < end; ++a) {
            for (std::size_t b = a + 1; b < shapes.size(); ++b)
                out[a][b] = match_signatures(shapes[a].signature, shapes[b].signature).distance;
        }
    });
    for (std::size_t a = 0; a < shapes.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) out[a][b] = out[b][a];
    }
    return out;
}

std::string matrix_csv(const std::vector<Shape>& shapes,
                       const std::vector<std::vector<double>>& distances) {
    std::string out = "shape";
    for (const Shape& shape : shapes) out += "," + batch::csv_field(shape.name);
    out += "\n";
    for (std::size_t a = 0; a < shapes.size(); ++a) {
        out += batch::csv_field(shapes[a].name);
        for (const double d : distances[a]) out += fmt::format(",{:.6g}", d);
        out += "\n";
    }
    return out;
}

// Two shapes: how far apart, and which node stands for which.
std::string pair_text(const Shape& a, const Shape& b, bool as_json) {
    const Match match = match_signatures(a.signature, b.signature);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes;
    for (std::size_t s = 0; s < a.signature.size(); ++s)
        nodes.emplace_back(a.signature[s].node, b.signature[match.other[s]].node);
    if (as_json) {
        const Json out{
            {"a", a.name}, {"b", b.name}, {"distance", match.distance}, {"nodes", nodes}};
        return out.dump() + "\n";
    }
    return fmt::format("{:.6g}\n", match.distance);
}

std::string neighbours_text(const Shape& query, const std::vector<Shape>& shapes,
                            const Arguments& arguments) {
    std::vector<double> distance(shapes.size());
    parallel_for(shapes.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s)
            distance[s] = match_signatures(query.signature, shapes[s].signature).distance;
    });
    std::vector<std::size_t> order(shapes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
    order.resize(std::min(order.size(), arguments.neighbours));
    if (arguments.as_json) {
        Json list = Json::array();
        for (const std::size_t s : order)
            list.push_back({{"shape", shapes[s].name}, {"distance", distance[s]}});
        return Json{{"query", query.name}, {"neighbours", list}}.dump(1) + "\n";
    }
    std::string out;
    for (const std::size_t s : order)
        out += fmt::format("{:.6g}  {}\n", distance[s], shapes[s].name);
    return out;
}

void write_tables(const std::vector<Shape>& shapes, const Arguments& arguments) {
    if (arguments.matrix.empty() && arguments.dendrogram.empty()) return;
    const auto distances = distances_of(shapes);
    if (!arguments.matrix.empty())
        write_output_text(arguments.matrix, matrix_csv(shapes, distances));
    if (arguments.dendrogram.empty()) return;
    std::vector<std::string> names;
    for (const Shape& shape : shapes) names.push_back(std::filesystem::path(shape.name).stem());
    write_output_text(arguments.dendrogram, dendrogram_svg(names, distances));
}

ExitCode match(const Arguments& arguments) {
    const bool has_index = !arguments.index.empty();
    if (!has_index && arguments.inputs.empty())
        throw UsageError("give two shapes or more, or --index");
    if (has_index && !arguments.inputs.empty()) {
        throw UsageError(
            "--index takes no shapes beside it: what is looked for there goes with --query");
    }
    if (!arguments.query.empty() && !has_index) throw UsageError("--query goes with --index");
    if (!has_index && arguments.inputs.size() < 2)
        throw UsageError("one shape alone has nothing to be compared with");
    const std::vector<std::string> outputs = {arguments.matrix, arguments.dendrogram,
                                              arguments.store};
    for (const std::string& input : arguments.inputs) check_outputs(input, outputs);
    check_outputs(arguments.index, outputs);
    std::vector<Shape> shapes;
    if (has_index) {
        shapes = indexed_shapes(arguments);
    } else {
        for (const std::string& input : arguments.inputs)
            shapes.push_back(shape_of(input, arguments));
    }
    write_tables(shapes, arguments);
    if (!arguments.store.empty()) write_output_text(arguments.store, write_signatures(shapes));
    if (!arguments.query.empty()) {
        print(neighbours_text(shape_of(arguments.query, arguments), shapes, arguments));
    } else if (shapes.size() == 2 && !has_index) {
        print(pair_text(shapes[0], shapes[1], arguments.as_json));
    } else if (std::all_of(outputs.begin(), outputs.end(),
                           [](const std::string& path) { return path.empty(); })) {
        print(matrix_csv(shapes, distances_of(shapes)));
    }
    return ExitCode::Ok;
}

}  // namespace

void add_match_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command =
        app.add_subcommand("match", "Compare shapes by their skeletons, whatever their pose");
    auto arguments = std::make_shared<Arguments>();
    command->add_option("shapes", arguments->inputs,
                        "Models, or skeletons with radii (.json, .graphml, .swc, .vtp): the "
                        "distance of two, or all distances of more (CSV)");
    command->add_option("--index", arguments->index,
                        "All skeletons in this folder, or a file that --store wrote");
    command->add_option("--query", arguments->query,
                        "The model or skeleton that is looked for there");
    command->add_option("--store", arguments->store,
                        "Keep what shapes are compared by in this file: the next time --index "
                        "takes it, and reads no skeletons");
    command->add_option("--neighbours", arguments->neighbours, "How many of the nearest to print")
        ->capture_default_str()
        ->check(CLI::Range(1, 1 << 30));
    command->add_option("--matrix", arguments->matrix, "Write all distances (CSV)");
    command->add_option("--dendrogram", arguments->dendrogram,
                        "Draw which shapes are near which, as a tree (SVG)");
    command->add_flag("--json", arguments->as_json,
                      "Print two shapes' distance and matched nodes, or the neighbours, as JSON");
    add_backend_options(*command, arguments->backend);
    command->footer(
        "Examples:\n  zskel match horse.obj bull.obj\n"
        "  zskel match horse.json bull.json --json\n"
        "  zskel match --index skeletons/ --query horse.obj\n"
        "  zskel match --index skeletons/ --matrix all.csv --dendrogram all.svg\n"
        "  zskel match --index skeletons/ --store all.idx\n"
        "  zskel match --index all.idx --query horse.obj");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] {
            arguments->reading = common.reading;
            return match(*arguments);
        };
    });
}

}  // namespace zskel::cli
