// The page is page/page.html with its style, its script and the data put in where it says so; the
// skeleton is the JSON that extract writes.
#include "zskel/io/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "page_sources.h"
#include "zskel/core/error.h"
#include "zskel/io/little_endian.h"
#include "zskel/io/markup.h"
#include "zskel/io/packing.h"
#ifdef ZSKEL_HAS_THREE
#include "three_sources.h"
#endif

namespace zskel {
namespace {

#ifdef ZSKEL_HAS_THREE
constexpr std::string_view kThree = three::kThreeModuleMinJs;
constexpr std::string_view kOrbit = three::kOrbitControlsJs;
#else
constexpr std::string_view kThree;
constexpr std::string_view kOrbit;
#endif

constexpr double kLastCode = 254.0;

// "@NAME@" replaced by what NAME stands for; anything else stays.
std::string fill(std::string_view text, const std::map<std::string_view, std::string>& values) {
    std::string out;
    while (!text.empty()) {
        const std::size_t at = text.find('@');
        out += text.substr(0, at);
        if (at == std::string_view::npos) break;
        text.remove_prefix(at);
        const std::size_t end = text.find('@', 1);
        const auto found = values.find(text.substr(1, end == std::string_view::npos ? 0 : end - 1));
        out += found == values.end() ? "@" : found->second;
        text.remove_prefix(found == values.end() ? 1 : end + 1);
    }
    return out;
}

// JSON that no text in it can end.
std::string escaped_json(const std::string& json) {
    std::string out;
    for (const char c : json) out += c == '<' ? "\\u003c" : std::string(1, c);
    return out;
}

// One byte a texel: 0 for a miss, else 1 near to 255 far, by the logarithm between a node's own
// nearest and farthest.
std::string codes_of(const VisibilityMaps& maps) {
    std::string out;
    for (const NodeMap& node : maps.nodes) {
        double least = std::numeric_limits<double>::max();
        double largest = 0.0;
        for (const float d : node.distance) {
            if (!std::isfinite(d) || d <= 0.0f) continue;
            least = std::min(least, static_cast<double>(d));
            largest = std::max(largest, static_cast<double>(d));
        }
        const double range = largest > least ? std::log(largest / least) : 1.0;
        for (const float d : node.distance) {
            const bool is_hit = std::isfinite(d) && d > 0.0f;
            const double share = is_hit ? std::log(static_cast<double>(d) / least) / range : 0.0;
            out.push_back(static_cast<char>(is_hit ? 1 + std::lround(share * kLastCode) : 0));
        }
    }
    return out;
}

std::string scene_json(const Surface& surface, const VisibilityMaps& maps) {
    std::string positions;
    for (const Vec3& p : surface.positions) {
        for (int axis = 0; axis < 3; ++axis) append_little_endian(positions, p[axis]);
    }
    std::string triangles;
    for (const Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) append_little_endian(triangles, t[k]);
    }
    const Similarity& world = surface.world_from_model;
    const nlohmann::ordered_json out{
        {"center", {world.center.x, world.center.y, world.center.z}},
        {"scale", world.scale},
        {"positions", base64(positions)},
        {"triangles", base64(triangles)},
        {"maps", {{"face_px", maps.face_px}, {"codes", base64(packed(codes_of(maps)))}}}};
    return out.dump();
}

}  // namespace

bool has_html_report() {
    return !kThree.empty();
}

std::string html_report(const ExtractResult& result, const Provenance& provenance,
                        const VisibilityMaps& maps) {
    if (!has_html_report()) {
        throw UsageError(
            "this zskel was built without three.js, which the report's page draws with; run "
            "tools/setup and build again");
    }
    if (maps.nodes.size() != result.graph.nodes.size()) {
        throw InputError(fmt::format("{}: maps of {} nodes for a skeleton of {}", provenance.model,
                                     maps.nodes.size(), result.graph.nodes.size()));
    }
    const std::string name = std::filesystem::path(provenance.model).filename().string();
    return fill(page::kPageHtml,
                {{"TITLE", escaped_markup(fmt::format("The skeleton of {}", name))},
                 {"CSS", std::string(page::kPageCss)},
                 {"THREE", base64(kThree)},
                 {"ORBIT", base64(kOrbit)},
                 {"SCRIPT", std::string(page::kPageJs)},
                 {"SKELETON", escaped_json(skeleton_json(result, provenance, {}))},
                 {"SCENE", scene_json(result.surface, maps)}});
}

}  // namespace zskel
