#include "zskel/io/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace zskel {
namespace {

using Json = nlohmann::ordered_json;

/// Components that the text shows one by one; JSON has them all.
constexpr std::size_t kComponentsShown = 8;

Json json_of(const DVec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json json_of(const Box& box) {
    return {{"low", json_of(box.low)}, {"high", json_of(box.high)}};
}

template <typename T>
Json json_of(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const ComponentReport& component) {
    return {{"triangles", component.triangles},     {"boundary_loops", component.boundary_loops},
            {"is_closed", component.is_closed},     {"is_manifold", component.is_manifold},
            {"is_oriented", component.is_oriented}, {"is_orientable", component.is_orientable},
            {"genus", json_of(component.genus)},    {"volume", json_of(component.volume)},
            {"box", json_of(component.box)}};
}

Json json_of(const Defect& defect) {
    return {{"name", defect.name},
            {"count", defect.count},
            {"example", defect.example},
            {"action", defect.action}};
}

template <typename T>
Json json_of(const std::vector<T>& items) {
    Json array = Json::array();
    for (const T& item : items) array.push_back(json_of(item));
    return array;
}

std::string box_text(const Box& box) {
    // No zero with a sign.
    const DVec3 low = box.low + 0.0;
    const DVec3 high = box.high + 0.0;
    return fmt::format("[{:.9g} {:.9g} {:.9g}] to [{:.9g} {:.9g} {:.9g}]", low.x, low.y, low.z,
                       high.x, high.y, high.z);
}

template <typename T>
std::string text_of(const std::optional<T>& value) {
    return value ? fmt::format("{:.6}", static_cast<double>(*value)) : "none";
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string component_text(std::size_t number, const ComponentReport& c) {
    return fmt::format(
        "  {:>3}  {} triangles, {}, {}, {}, genus {}, volume {}, {}\n", number, c.triangles,
        c.is_closed ? "closed" : counted(c.boundary_loops, "boundary loop", "boundary loops"),
        c.is_manifold ? "manifold" : "not manifold",
        c.is_oriented     ? "oriented"
        : c.is_orientable ? "not oriented"
                          : "not orientable",
        text_of(c.genus), text_of(c.volume), box_text(c.box));
}

std::string defect_text(const Defect& defect) {
    std::string name = defect.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    return fmt::format("  {}: {}, first {}; {}\n", name, defect.count, defect.example,
                       defect.action);
}

}  // namespace

std::string to_json(const MeshReport& report) {
    const Json json = {{"name", report.name},
                       {"hash", fmt::format("{:016x}", report.hash)},
                       {"vertices", report.vertices},
                       {"faces", report.faces},
                       {"triangles", report.triangles},
                       {"coincident_vertices", report.coincident_vertices},
                       {"unreferenced_vertices", report.unreferenced_vertices},
                       {"degenerate_triangles", report.degenerate_triangles},
                       {"flat_triangles", report.flat_triangles},
                       {"duplicate_triangles", report.duplicate_triangles},
                       {"crossing_triangles", json_of(report.crossing_triangles)},
                       {"boundary_edges", report.boundary_edges},
                       {"boundary_loops", report.boundary_loops},
                       {"non_manifold_edges", report.non_manifold_edges},
                       {"non_manifold_vertices", report.non_manifold_vertices},
                       {"inconsistent_edges", report.inconsistent_edges},
                       {"genus", json_of(report.genus)},
                       {"volume", json_of(report.volume)},
                       {"box", json_of(report.box)},
                       {"components", json_of(report.components)},
                       {"defects", json_of(report.defects)},
                       {"warnings", report.warnings}};
    // Names may hold any bytes; what is no UTF-8 is replaced rather than refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const MeshReport& report) {
    std::string text = fmt::format(
        "{}: {}, {}, {}, {}\n", report.name, counted(report.vertices, "vertex", "vertices"),
        counted(report.faces, "face", "faces"), counted(report.triangles, "triangle", "triangles"),
        counted(report.components.size(), "component", "components"));
    text += fmt::format("  box {}, volume {}, genus {}\n", box_text(report.box),
                        text_of(report.volume), text_of(report.genus));
    const std::size_t shown = std::min(report.components.size(), kComponentsShown);
    for (std::size_t i = 0; i < shown; ++i) text += component_text(i, report.components[i]);
    if (shown < report.components.size()) {
        text += fmt::format("       and {} more components\n", report.components.size() - shown);
    }
    for (const std::string& warning : report.warnings) {
        text += fmt::format("  reading: {}\n", warning);
    }
    for (const Defect& defect : report.defects) text += defect_text(defect);
    if (report.defects.empty()) text += "  nothing to repair\n";
    return text;
}

}  // namespace zskel
