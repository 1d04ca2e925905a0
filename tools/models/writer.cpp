#include "writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

namespace zskel::models {
namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) {
        throw std::runtime_error(
            fmt::format("cannot write {}: is the folder there?", path.string()));
    }
}

/// Nearest number with five decimals, so that the shortest text of it is short.
double short_number(double x) {
    return std::round(x / kFileStep) / std::round(1.0 / kFileStep);
}

std::string obj_text(const Model& model) {
    std::string text = fmt::format("# zskel make_models: {}\n", model.name);
    for (const glm::dvec3& v : model.mesh.vertices) {
        text +=
            fmt::format("v {} {} {}\n", short_number(v.x), short_number(v.y), short_number(v.z));
    }
    for (const glm::uvec3& f : model.mesh.faces) {
        text += fmt::format("f {} {} {}\n", f.x + 1, f.y + 1, f.z + 1);
    }
    return text;
}

std::string bpt_text(const Model& model) {
    std::string text = fmt::format("{}\n", model.patches.size());
    for (const BezierPatch& patch : model.patches) {
        text += "3 3\n";
        for (const auto& row : patch) {
            for (const glm::dvec3& p : row) {
                text += fmt::format("{} {} {}\n", short_number(p.x), short_number(p.y),
                                    short_number(p.z));
            }
        }
    }
    return text;
}

std::string skeleton_text(const Model& model) {
    nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
    for (const Truth::Node& node : model.truth.nodes) {
        const glm::dvec3& p = node.position;
        nodes.push_back({{"id", nodes.size()},
                         {"position", {short_number(p.x), short_number(p.y), short_number(p.z)}},
                         {"radius", short_number(node.radius)}});
    }
    nlohmann::ordered_json edges = nlohmann::ordered_json::array();
    for (const auto& [source, target] : model.truth.edges) {
        edges.push_back({{"source", source}, {"target", target}});
    }
    nlohmann::ordered_json limbs = nlohmann::ordered_json::array();
    for (const TruthLimb& limb : model.truth.limbs) {
        limbs.push_back({{"name", limb.name}, {"tube", limb.is_tube}, {"nodes", limb.nodes}});
    }
    const auto list = [](const nlohmann::ordered_json& items) {
        std::string text = "[\n";
        for (std::size_t i = 0; i < items.size(); ++i) {
            text += "  " + items[i].dump() + (i + 1 < items.size() ? ",\n" : "\n");
        }
        return text + "]";
    };
    return fmt::format(
        "{{\n\"version\": 1,\n\"model\": \"{}\",\n\"ends\": {},\n\"cycles\": {},\n"
        "\"nodes\": {},\n\"edges\": {},\n\"limbs\": {}\n}}\n",
        model.name, model.expected.ends, model.expected.cycles, list(nodes), list(edges),
        list(limbs));
}

}  // namespace

void write_model(const Model& model, const std::filesystem::path& folder) {
    if (model.patches.empty()) {
        write_text(folder / (model.name + ".obj"), obj_text(model));
    } else {
        write_text(folder / (model.name + ".bpt"), bpt_text(model));
    }
    write_text(folder / (model.name + ".skeleton.json"), skeleton_text(model));
}

}  // namespace zskel::models
