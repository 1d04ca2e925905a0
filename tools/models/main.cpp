#include "catalogue.h"
#include "check.h"
#include "writer.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace models = zskel::models;

/// @return whether the model passes, or was not to be checked.
bool make_one(const models::Recipe& recipe, const std::filesystem::path& folder, bool is_checked) {
    models::Model model = recipe.make();
    models::round_vertices(model.mesh, models::kFileStep);
    models::write_model(model, folder);
    if (!is_checked) {
        fmt::print("{}: {} faces\n", model.name, model.mesh.faces.size());
        return true;
    }
    const models::CheckResult result = models::check_model(model);
    fmt::print("{}\n", result.measured);
    for (const std::string& failure : result.failures) {
        fmt::print("  FAILED {}\n", failure);
    }
    std::fflush(stdout);
    return result.failures.empty();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Makes zskel's models, each with the skeleton that it was built from.");
    std::string folder;
    std::vector<std::string> names;
    bool is_checked = false;
    std::vector<std::string> known;
    for (const models::Recipe& recipe : models::catalogue()) {
        known.push_back(recipe.name);
    }
    app.add_option("--out", folder, "Folder for NAME.obj (or NAME.bpt) and NAME.skeleton.json")
        ->required();
    app.add_option("names", names, "What to make; everything when none is named")
        ->check(CLI::IsMember(known));
    app.add_flag("--check", is_checked,
                 "Measure every model; exit with 1 when one is not as expected");
    CLI11_PARSE(app, argc, argv);
    try {
        std::filesystem::create_directories(folder);
        bool is_good = true;
        for (const models::Recipe& recipe : models::catalogue()) {
            if (names.empty() ||
                std::find(names.begin(), names.end(), recipe.name) != names.end()) {
                is_good &= make_one(recipe, folder, is_checked);
            }
        }
        return is_good ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_models: {}\n", error.what());
        return 2;
    }
}
