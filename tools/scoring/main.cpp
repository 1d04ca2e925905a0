// Scores skeletons of models: runs the extraction or takes skeletons already made, measures them,
// and prints the table; as a page with pictures and as JSON on request.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "scoring/extractor.h"
#include "scoring/page.h"
#include "scoring/score.h"
#include "scoring/table.h"
#include "zskel/core/error.h"
#include "zskel/core/log.h"
#include "zskel/io/output_file.h"
#include "zskel/io/picture.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/visibility/backend.h"

namespace zskel::scoring {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureWidth = 760;
constexpr int kPictureHeight = 570;

struct Arguments {
    std::vector<std::string> models;
    std::string default_models = "models";
    std::string page;
    std::string json;
    std::string skeletons;  // folder of skeletons already made
    std::string save;       // folder that skeletons made here go to
    std::vector<std::string> compare;
    bool is_strict = false;
    Extractor extractor{"zskel", {}};
};

bool is_model(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".obj" || extension == ".off" || extension == ".ply" ||
           extension == ".stl" || extension == ".bpt";
}

// Folders become the models in them, by name.
std::vector<fs::path> model_files(const std::vector<std::string>& names) {
    std::vector<fs::path> out;
    for (const std::string& name : names) {
        if (!fs::is_directory(name)) {
            out.emplace_back(name);
            continue;
        }
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(name)) {
            if (is_model(entry.path())) found.push_back(entry.path());
        }
        std::sort(found.begin(), found.end());
        out.insert(out.end(), found.begin(), found.end());
    }
    if (out.empty()) throw UsageError("there is no model to score");
    return out;
}

// Pictures by any GL context; without one, why there are none.
class Painter {
  public:
    explicit Painter(bool is_wanted) {
        if (!is_wanted) return;
        try {
            context_ = open_picture_context();
        } catch (const GlError& error) {
            missing_ = error.what();
            log_warning("no pictures: {}", missing_);
        }
    }
    std::string draw(const Subject& subject, const SkeletonGraph& graph, const std::string& name) {
        if (!context_) return {};
        PictureOptions options;
        options.width_px = kPictureWidth;
        options.height_px = kPictureHeight;
        return encode_png(draw_skeleton(*context_, subject.surface(), graph, options), name);
    }
    const std::string& missing() const { return missing_; }

  private:
    std::unique_ptr<gl::Context> context_;
    std::string missing_;
};

std::string skeleton_in(const std::string& folder, const std::string& name) {
    for (const char* extension : {".json", ".skeleton.json"}) {
        const fs::path path = fs::path(folder) / (name + extension);
        if (fs::exists(path)) return path.string();
    }
    throw InputError(fmt::format("{}: no {}.json in there", folder, name));
}

Row score_model(const fs::path& model, const std::string& skeleton_path, Painter& painter) {
    const Subject subject(read_mesh(model.string()));
    const SkeletonFile skeleton = read_skeleton(skeleton_path);
    const fs::path truth_path = fs::path(model).replace_extension(".skeleton.json");
    std::optional<Truth> truth;
    if (fs::exists(truth_path)) truth = read_truth(truth_path.string());
    Row row{model.stem().string(), "", {}, ""};
    row.score = score_skeleton(subject, skeleton, truth ? &*truth : nullptr);
    row.picture = painter.draw(subject, skeleton.graph, row.name);
    return row;
}

std::vector<Row> score_models(const Arguments& arguments, Painter& painter) {
    const ScratchFolder scratch;
    const std::string& made = arguments.save.empty() ? scratch.path() : arguments.save;
    std::vector<Row> rows;
    for (const fs::path& model : model_files(
             arguments.models.empty() ? std::vector{arguments.default_models} : arguments.models)) {
        const std::string name = model.stem().string();
        log_info("{}", name);
        try {
            std::string skeleton = (fs::path(made) / (name + ".json")).string();
            if (arguments.skeletons.empty()) {
                arguments.extractor.run(model.string(), skeleton);
            } else {
                skeleton = skeleton_in(arguments.skeletons, name);
            }
            rows.push_back(score_model(model, skeleton, painter));
        } catch (const std::exception& error) {
            rows.push_back({name, error.what(), {}, ""});
        }
    }
    return rows;
}

std::string subtitle(const Arguments& arguments) {
    if (!arguments.skeletons.empty()) return "skeletons from " + arguments.skeletons;
    return fmt::format("zskel extract {}", fmt::join(arguments.extractor.options, " "));
}

ExitCode score(const Arguments& arguments) {
    if (!arguments.save.empty()) fs::create_directories(arguments.save);
    Painter painter(!arguments.page.empty());
    const std::vector<Row> rows = score_models(arguments, painter);
    write_output_text("-", table_text(rows));
    if (!arguments.json.empty()) write_output_text(arguments.json, table_json(rows));
    if (!arguments.page.empty())
        write_output_text(arguments.page, page_html(rows, subtitle(arguments), painter.missing()));
    return arguments.is_strict && !totals_of(rows).are_zero() ? ExitCode::Check : ExitCode::Ok;
}

ExitCode compare(const std::vector<std::string>& names) {
    const Subject subject(read_mesh(names[2]));
    const SkeletonDistance distance =
        compare_curves(subject, read_skeleton(names[0]).graph, read_skeleton(names[1]).graph);
    write_output_text(
        "-", fmt::format("mean {:.6f}\nhausdorff {:.6f}\n", distance.mean, distance.hausdorff));
    return ExitCode::Ok;
}

void add_options(CLI::App& app, Arguments& arguments) {
    app.add_option("models", arguments.models,
                   "Models, or folders of models; MODEL.skeleton.json beside one is its truth");
    app.add_option("--default", arguments.default_models, "What is scored when no model is named")
        ->capture_default_str();
    app.add_option("-o,--output", arguments.page, "Write the table with pictures as a page (HTML)");
    app.add_option("--json", arguments.json, "Write every number as JSON");
    app.add_option("--skeletons", arguments.skeletons,
                   "Score MODEL.json (or MODEL.skeleton.json) in this folder; extract nothing");
    app.add_option("--save", arguments.save, "Keep the skeletons in this folder");
    app.add_option("--program", arguments.extractor.program, "The zskel that extracts")
        ->capture_default_str();
    app.add_flag("--strict", arguments.is_strict,
                 "Exit 6 unless nothing failed and no topology is wrong, nothing outside, no spur, "
                 "no limb missed or invented");
    app.add_option("--compare", arguments.compare,
                   "Print the distance between two skeletons of a model, in diagonals: the mean of "
                   "both ways, and the largest (Hausdorff)")
        ->expected(3)
        ->type_name("A.json B.json MODEL");
    app.footer(
        "What follows -- goes to zskel extract.\nExample:\n"
        "  tools/score models -o score.html --json score.json -- --backend ray");
}

int run(int argc, char** argv) {
    Arguments arguments;
    const auto split = std::find(argv, argv + argc, std::string_view("--"));
    if (split != argv + argc) arguments.extractor.options.assign(split + 1, argv + argc);
    CLI::App app("Scores the skeletons of models", "score");
    add_options(app, arguments);
    try {
        app.parse(static_cast<int>(split - argv), argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
    }
    set_log(LogLevel::Info, LogFormat::Text);  // which model it is at
    try {
        return static_cast<int>(arguments.compare.empty() ? score(arguments)
                                                          : compare(arguments.compare));
    } catch (const Error& error) {
        log_line(LogLevel::Error, error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        log_line(LogLevel::Error, error.what());
        return static_cast<int>(ExitCode::Internal);
    }
}

}  // namespace
}  // namespace zskel::scoring

int main(int argc, char** argv) {
    return zskel::scoring::run(argc, argv);
}
