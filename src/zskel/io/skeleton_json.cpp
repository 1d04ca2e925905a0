#include "zskel/io/skeleton_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "zskel/io/format_io.h"

namespace zskel {
namespace {

using Json = nlohmann::ordered_json;

Json point(const DVec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json nodes_json(const SkeletonGraph& graph) {
    Json nodes = Json::array();
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const SkeletonGraph::Node& node = graph.nodes[i];
        nodes.push_back({{"id", i},
                         {"position", point(node.position)},
                         {"radius", node.radius},
                         {"volume", node.volume},
                         {"solid", node.solid}});
        if (node.is_open_end) nodes.back()["open_end"] = true;
    }
    return nodes;
}

Json edges_json(const SkeletonGraph& graph) {
    Json edges = Json::array();
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        edges.push_back({{"source", edge.source}, {"target", edge.target}});
    }
    return edges;
}

std::string_view kind_of(const SkeletonGraph& graph, std::uint32_t node, std::uint32_t degree) {
    if (degree == 1) return graph.nodes[node].is_open_end ? "open_end" : "end";
    return degree == 2 ? "ring" : "junction";
}

// Tortuosity is null where a branch comes back to its start.
Json branches_json(const SkeletonGraph& graph) {
    Json list = Json::array();
    for (const Branch& branch : find_branches(graph)) {
        list.push_back({{"nodes", branch.nodes},
                        {"from", kind_of(graph, branch.nodes.front(), branch.start_degree)},
                        {"to", kind_of(graph, branch.nodes.back(), branch.stop_degree)},
                        {"length", branch.length},
                        {"mean_radius", branch.mean_radius},
                        {"tortuosity", branch.tortuosity}});
    }
    return list;
}

// -1 where a vertex has no face and so no node.
Json vertex_node_json(const SkeletonGraph& graph) {
    Json list = Json::array();
    for (const std::uint32_t node : graph.vertex_node) {
        list.push_back(node == kNone ? std::int64_t{-1} : static_cast<std::int64_t>(node));
    }
    return list;
}

// "cut": the loop measured goes round the handle itself; "filled": round the hole.
Json handles_json(const ExtractResult& result) {
    Json list = Json::array();
    for (const IgnoredHandle& handle : result.ignored_handles) {
        list.push_back({{"radius", handle.radius},
                        {"position", point(handle.position)},
                        {"treated_as", handle.is_cut ? "cut" : "filled"},
                        {"solid", handle.solid}});
    }
    return list;
}

Json statistics_json(const ExtractResult& result) {
    const ExtractStatistics& s = result.statistics;
    const GraphTopology topology = graph_topology(result.graph);
    Json states;
    for (const SeedState state :
         {SeedState::Converged, SeedState::StepLimit, SeedState::LeftMesh, SeedState::NoHits}) {
        const auto count =
            std::count_if(result.seeds.begin(), result.seeds.end(),
                          [&](const SeedReport& seed) { return seed.state == state; });
        states[std::string(name_of(state))] = count;
    }
    Json seconds;
    for (const StageTime& stage : s.stages) seconds[stage.stage] = stage.seconds;
    seconds["total"] = s.seconds();
    return {{"faces", s.faces},
            {"vertices", s.vertices},
            {"solids", s.solids},
            {"cavities", s.cavities},
            {"openings", s.openings},
            {"open_ends", s.open_ends},
            {"nodes", result.graph.nodes.size()},
            {"edges", result.graph.edges.size()},
            {"edges_without_cycles", s.forest_edges},
            {"components", topology.components},
            {"cycles", topology.cycles},
            {"expected_cycles", s.expected_cycles},
            {"ignored_handles", result.ignored_handles.size()},
            {"limbs", s.limbs},
            {"rejected_limbs", s.rejected_limbs},
            {"merged_junctions", s.refine.merged_junctions},
            {"unfolded_branches", s.refine.unfolded_branches},
            {"zipped_branches", s.refine.zipped_branches},
            {"extended_ends", s.refine.extended_ends},
            {"seeds", s.seeds},
            {"seed_spacing_thickness", s.seed_spacing_thickness},
            {"seeds_ended_by", name_of(s.seed_end)},
            {"seed_states", states},
            {"evaluations", s.evaluations},
            {"seconds", seconds}};
}

Json repairs_json(const ExtractResult& result) {
    Json list = Json::array();
    for (const Repair& repair : result.repairs)
        list.push_back({{"what", repair.what}, {"count", repair.count}});
    return list;
}

// What was not looked for is null.
Json self_check_json(const SelfCheck& check) {
    Json cycles;
    if (check.expected_cycles) cycles = *check.expected_cycles;
    Json inside;
    if (check.share_inside) inside = *check.share_inside;
    return {{"is_sound", check.failures.empty()},
            {"components", check.components},
            {"expected_components", check.expected_components},
            {"cycles", check.cycles},
            {"expected_cycles", cycles},
            {"share_inside", inside},
            {"least_clearance", check.least_clearance},
            {"failures", check.failures}};
}

Json options_json(const Provenance& provenance) {
    const ExtractOptions& o = provenance.options;
    Json out{{"method", name_of(o.method)},
             {"backend", name_of(provenance.backend_options.kind)},
             {"gpu", provenance.backend_options.gpu},
             {"face_px", provenance.backend_options.face_px},
             {"rays", provenance.backend_options.rays},
             {"exact", provenance.backend_options.exact},
             {"repairs", o.repair.is_allowed},
             {"weld_tolerance_diagonals", o.repair.weld_tolerance_diagonals},
             {"caps", o.repair.has_caps},
             {"join", o.join.has_value()}};
    if (o.join) out["join_voxel_model"] = o.join->voxel_model;
    if (o.method == Method::Paper) {
        out.update({{"offset_world", o.paper.seeds.offset_world},
                    {"max_offset_thickness", o.paper.seeds.max_offset_thickness},
                    {"step_world", o.paper.steps.step_world},
                    {"max_steps", o.paper.steps.max_steps},
                    {"cluster_range_world", o.paper.clusters.range_world}});
    } else {
        out.update({{"offset_world", o.newton.seeds.offset_world},
                    {"max_offset_thickness", o.newton.seeds.max_offset_thickness},
                    {"min_seeds", o.newton.spread.min_seeds},
                    {"fine_thickness", o.newton.spread.fine_thickness},
                    {"many_seeds", o.newton.spread.many_seeds},
                    {"coarse_thickness", o.newton.spread.coarse_thickness},
                    {"max_seeds", o.newton.spread.max_seeds},
                    {"max_steps", o.newton.steps.max_steps},
                    {"cluster_radii", o.newton.cluster_radii},
                    {"min_handle_model", o.newton.min_handle_model},
                    {"detail", o.newton.limbs.detail},
                    {"sweeps", o.newton.refine.sweeps},
                    {"centring", o.newton.refine.centring},
                    {"smoothing", o.newton.refine.smoothing},
                    {"resample_model", o.newton.resample_model}});
    }
    return out;
}

Json provenance_json(const Provenance& provenance, const Similarity& world) {
    Json failed = Json::array();
    for (const gl::FailedAttempt& attempt : provenance.backend.failed) {
        failed.push_back({{"candidate", attempt.candidate}, {"reason", attempt.reason}});
    }
    return {{"program", "zskel"},
            {"program_version", ZSKEL_VERSION},
            {"command", provenance.command},
            {"model", provenance.model},
            {"model_xxh3", fmt::format("{:016x}", provenance.model_hash)},
            {"options", options_json(provenance)},
            {"backend",
             {{"name", provenance.backend.name},
              {"vendor", provenance.backend.vendor},
              {"renderer", provenance.backend.renderer},
              {"version", provenance.backend.version},
              {"reason", provenance.backend.reason},
              {"failed", failed}}},
            {"world_from_model", {{"center", point(world.center)}, {"scale", world.scale}}}};
}

Json seeds_json(const ExtractResult& result, const JsonParts& parts) {
    Json seeds = Json::array();
    for (const SeedReport& seed : result.seeds) {
        Json entry{{"vertex", seed.vertex},          {"node", seed.node},
                   {"start", point(seed.start)},     {"end", point(seed.end)},
                   {"state", name_of(seed.state)},   {"steps", seed.steps},
                   {"evaluations", seed.evaluations}};
        if (parts.paths) {
            Json path = Json::array();
            for (const DVec3& p : seed.path) path.push_back(point(p));
            entry["path"] = std::move(path);
        }
        seeds.push_back(std::move(entry));
    }
    return seeds;
}

std::string text(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

using Members = std::vector<std::pair<std::string, std::string>>;

// An array with a line for each element.
std::string rows(const Json& array) {
    std::string out;
    for (const Json& element : array)
        out += fmt::format("{}\n {}", out.empty() ? "" : ",", text(element));
    return fmt::format("[{}]", out);
}

Members graph_members(const SkeletonGraph& graph) {
    return {
        {"format", "\"zskel-skeleton\""},         {"version", "1"},
        {"nodes", rows(nodes_json(graph))},       {"edges", rows(edges_json(graph))},
        {"branches", rows(branches_json(graph))}, {"vertex_node", text(vertex_node_json(graph))}};
}

std::string object(const Members& members) {
    std::string out;
    for (const auto& [name, value] : members) {
        out += fmt::format("{}\"{}\": {}", out.empty() ? "{\n" : ",\n", name, value);
    }
    return out + "\n}\n";
}

}  // namespace

std::string skeleton_json(const ExtractResult& result, const Provenance& provenance,
                          const JsonParts& parts) {
    Members members = graph_members(result.graph);
    members.emplace_back("ignored_handles", rows(handles_json(result)));
    members.emplace_back("statistics", text(statistics_json(result)));
    members.emplace_back("self_check", text(self_check_json(result.check)));
    members.emplace_back("repairs", rows(repairs_json(result)));
    members.emplace_back("warnings", rows(Json(result.warnings)));
    members.emplace_back("provenance",
                         text(provenance_json(provenance, result.surface.world_from_model)));
    if (!parts.maps.empty()) members.emplace_back("visibility_maps", text(Json(parts.maps)));
    if (parts.seeds || parts.paths) members.emplace_back("seeds", rows(seeds_json(result, parts)));
    return object(members);
}

std::string options_text(const Provenance& provenance) {
    return text(options_json(provenance));
}

std::string write_graph_json(const SkeletonGraph& graph, const std::string& command) {
    const GraphTopology topology = graph_topology(graph);
    const Json statistics{{"nodes", graph.nodes.size()},
                          {"edges", graph.edges.size()},
                          {"components", topology.components},
                          {"cycles", topology.cycles}};
    const Json provenance{
        {"program", "zskel"}, {"program_version", ZSKEL_VERSION}, {"command", command}};
    Members members = graph_members(graph);
    members.emplace_back("statistics", text(statistics));
    members.emplace_back("provenance", text(provenance));
    return object(members);
}

}  // namespace zskel
