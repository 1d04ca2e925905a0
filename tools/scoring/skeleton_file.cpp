#include "scoring/skeleton_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "zskel/core/error.h"

namespace zskel::scoring {
namespace {

using Json = nlohmann::json;

SkeletonGraph::Node node_of(const Json& json) {
    const Json& place = json.is_object() ? json.at("position") : json;
    SkeletonGraph::Node node;
    for (int k = 0; k < 3; ++k) {
        node.position[k] = place.at(static_cast<std::size_t>(k)).get<double>();
        if (!std::isfinite(node.position[k])) throw InputError("a node's position is not finite");
    }
    if (json.is_object()) node.radius = json.value("radius", 0.0);
    return node;
}

// Node numbers as edges name them, to places in the list.
class NodeNumbers {
  public:
    explicit NodeNumbers(const Json& nodes) {
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const std::int64_t id =
                nodes[i].is_object() ? nodes[i].value("id", std::int64_t{i}) : i;
            place_[id] = i;
        }
    }
    std::uint32_t operator()(const Json& id) const {
        const auto at = place_.find(id.get<std::int64_t>());
        if (at == place_.end()) throw InputError(fmt::format("there is no node {}", id.dump()));
        return at->second;
    }

  private:
    std::map<std::int64_t, std::uint32_t> place_;
};

std::vector<SkeletonGraph::Edge> edges_of(const Json& edges, const NodeNumbers& number) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Json& edge : edges) {
        const bool is_object = edge.is_object();
        const std::uint32_t a = number(is_object ? edge.at("source") : edge.at(0));
        const std::uint32_t b = number(is_object ? edge.at("target") : edge.at(1));
        if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<SkeletonGraph::Edge> out;
    for (const auto& [source, target] : pairs) out.push_back({source, target});
    return out;
}

SkeletonFile skeleton_of(const Json& json) {
    SkeletonFile out;
    const Json& nodes = json.at("nodes");
    for (const Json& node : nodes) out.graph.nodes.push_back(node_of(node));
    out.has_radii = std::all_of(nodes.begin(), nodes.end(), [](const Json& node) {
        return node.is_object() && node.contains("radius");
    });
    out.graph.edges = edges_of(json.at("edges"), NodeNumbers(nodes));
    const Json statistics = json.value("statistics", Json::object());
    if (statistics.contains("evaluations")) out.evaluations = statistics["evaluations"];
    const Json seconds = statistics.value("seconds", Json::object());
    if (seconds.contains("total")) out.seconds = seconds["total"];
    return out;
}

Truth truth_of(const Json& json) {
    const SkeletonFile file = skeleton_of(json);
    if (!file.has_radii) throw InputError("a node has no radius");
    Truth truth{file.graph, {}};
    const NodeNumbers number(json.at("nodes"));
    for (const Json& limb : json.at("limbs")) {
        Limb& out = truth.limbs.emplace_back(Limb{limb.at("name"), {}, limb.at("tube")});
        for (const Json& node : limb.at("nodes")) out.nodes.push_back(number(node));
        if (out.nodes.empty()) throw InputError(fmt::format("limb {} has no nodes", out.name));
    }
    return truth;
}

// What goes wrong in a file is told with its path.
template <typename Read>
auto read_as(const std::string& path, Read read) {
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: cannot be read", path));
    try {
        return read(Json::parse(file));
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: {}", path, error.what()));
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path, error.what()));
    }
}

}  // namespace

SkeletonFile read_skeleton(const std::string& path) {
    return read_as(path, skeleton_of);
}

Truth read_truth(const std::string& path) {
    return read_as(path, truth_of);
}

}  // namespace zskel::scoring
