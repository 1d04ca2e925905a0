#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "scoring/limbs.h"
#include "scoring/page.h"
#include "scoring/score.h"
#include "scoring/shape.h"
#include "scoring/table.h"
#include "support/shapes.h"
#include "zskel/core/error.h"

using namespace zskel;
using namespace zskel::scoring;

namespace {

SkeletonGraph graph_of(const std::vector<DVec3>& places,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
    SkeletonGraph graph;
    for (const DVec3& p : places) graph.nodes.push_back({p, 0.1, 0});
    for (const auto& [a, b] : edges) graph.edges.push_back({a, b});
    return graph;
}

SkeletonFile file_of(const std::vector<DVec3>& places,
                     const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
    SkeletonFile file;
    file.graph = graph_of(places, edges);
    return file;
}

Truth true_skeleton(const std::string& model) {
    return read_truth(std::string(ZSKEL_MODELS) + "/" + model + ".skeleton.json");
}

// From a junction to a free end, with nothing growing on it.
bool is_twig(const Limb& limb, const std::vector<std::uint32_t>& degrees) {
    return degrees[limb.nodes.front()] >= 3 && degrees[limb.nodes.back()] == 1 &&
           std::all_of(limb.nodes.begin() + 1, limb.nodes.end() - 1,
                       [&](std::uint32_t n) { return degrees[n] == 2; });
}

// The skeleton without a limb: its nodes stay only where others have them too.
SkeletonGraph without(const Truth& truth, const Limb& limb) {
    const auto has = [&](std::uint32_t n) {
        return std::find(limb.nodes.begin() + 1, limb.nodes.end(), n) != limb.nodes.end();
    };
    std::vector<std::uint32_t> place(truth.graph.nodes.size(), kNone);
    SkeletonGraph out;
    for (std::uint32_t n = 0; n < place.size(); ++n) {
        if (has(n)) continue;
        place[n] = static_cast<std::uint32_t>(out.nodes.size());
        out.nodes.push_back(truth.graph.nodes[n]);
    }
    for (const auto& [a, b] : truth.graph.edges) {
        if (place[a] != kNone && place[b] != kNone) out.edges.push_back({place[a], place[b]});
    }
    return out;
}

// A new end, straight from a node of the truth.
SkeletonGraph with_end(const Truth& truth, std::uint32_t node, const DVec3& offset) {
    SkeletonGraph out = truth.graph;
    const auto added = static_cast<std::uint32_t>(out.nodes.size());
    out.nodes.push_back({truth.graph.nodes[node].position + offset, 0.001, 0});
    out.edges.push_back({node, added});
    std::sort(out.edges.begin(), out.edges.end(), [](const auto& l, const auto& r) {
        return std::tie(l.source, l.target) < std::tie(r.source, r.target);
    });
    return out;
}

std::string written(const char* name, const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / name;
    std::ofstream(path) << text;
    return path.string();
}

}  // namespace

TEST_CASE("score: the truth against itself is right in everything") {
    for (const std::string model :
         {"horse", "hand", "frog", "torus", "sphere", "plant", "capsule"}) {
        CAPTURE(model);
        const Truth truth = true_skeleton(model);
        const TruthScore score = score_against(truth, truth.graph);
        CHECK(score.limbs >= truth.limbs.size());
        CHECK(score.missed.empty());
        CHECK(score.invented.empty());
        CHECK(score.from_truth == doctest::Approx(0.0));
        CHECK(score.to_truth == doctest::Approx(0.0));
        CHECK(score.radius_error.value_or(0.0) == doctest::Approx(0.0));
    }
}

TEST_CASE("score: a limb that is taken away is missed, by name, and no other") {
    std::size_t tried = 0;
    for (const char* model : {"horse", "hand", "frog", "octopus", "plant"}) {
        const Truth truth = true_skeleton(model);
        const std::vector<std::uint32_t> degrees = node_degrees(truth.graph);
        for (const Limb& limb : truth.limbs) {
            if (!is_twig(limb, degrees)) continue;
            CAPTURE(limb.name);
            const TruthScore score = score_against(truth, without(truth, limb));
            REQUIRE(score.missed.size() == 1);
            CHECK(score.missed[0] == limb.name);
            CHECK(score.invented.empty());
            CHECK(score.from_truth > 100 * score.to_truth);
            ++tried;
        }
    }
    CHECK(tried > 25);
}

TEST_CASE("score: a limb that is added is invented, unless it stays near to the truth") {
    const Truth truth = true_skeleton("horse");
    const std::uint32_t middle = truth.limbs[0].nodes[4];
    REQUIRE(truth.limbs[0].name == "back");
    const double radius = truth.graph.nodes[middle].radius;
    const TruthScore far =
        score_against(truth, with_end(truth, middle, DVec3(0.0, 0.9 * radius, 0.0)));
    CHECK(far.missed.empty());
    REQUIRE(far.invented.size() == 1);
    CHECK(far.invented[0] == "back");
    const TruthScore near =
        score_against(truth, with_end(truth, middle, DVec3(0.0, 0.3 * radius, 0.0)));
    CHECK(near.invented.empty());
}

TEST_CASE("score: two ends at one limb stand for one limb") {
    const Truth truth = true_skeleton("horse");
    const Limb& tail = truth.limbs.back();
    REQUIRE(tail.name == "tail");
    const std::uint32_t near_tip = tail.nodes[tail.nodes.size() - 3];
    const double radius = truth.graph.nodes[near_tip].radius;
    const TruthScore score =
        score_against(truth, with_end(truth, near_tip, DVec3(0.0, 0.0, 1.2 * radius)));
    CHECK(score.missed.empty());
    CHECK(score.invented == std::vector<std::string>{"tail"});
}

TEST_CASE("score: a limb that is cut short before its last third is missed, not invented") {
    Truth truth = true_skeleton("horse");
    Limb half = truth.limbs.back();
    half.nodes.erase(half.nodes.begin(),
                     half.nodes.begin() + static_cast<std::ptrdiff_t>(half.nodes.size() / 3));
    const TruthScore score = score_against(truth, without(truth, half));
    CHECK(score.missed == std::vector<std::string>{"tail"});
    CHECK(score.invented.empty());
}

TEST_CASE("score: radii that are all a tenth too large are a tenth off") {
    Truth truth = true_skeleton("y");
    SkeletonGraph ours = truth.graph;
    for (SkeletonGraph::Node& node : ours.nodes) node.radius *= 1.1;
    CHECK(*score_against(truth, ours).radius_error == doctest::Approx(0.1));
}

TEST_CASE("assign: moves others to their second choice") {
    const std::vector<std::uint32_t> left = assign({{0, 1}, {0}, {}}, 3);
    CHECK(left == std::vector<std::uint32_t>{1, 0, kNone});
}

TEST_CASE("score: the axis of a cylinder is in its centre, one beside it as far as it should be") {
    const double radius = 0.2;
    const Subject subject(test::cylinder(radius, 2.0));
    const Score axis =
        score_skeleton(subject, file_of({{0, 0, -0.8}, {0, 0, 0.8}}, {{0, 1}}), nullptr);
    CHECK(axis.is_topology_right());
    CHECK(axis.inside == 1.0);
    CHECK(*axis.off_centre_median == doctest::Approx(0.0).epsilon(1e-3));
    CHECK(*axis.turn_deg == doctest::Approx(0.0));
    CHECK(axis.spurs == 0);
    CHECK(*axis.cover_le2 > 0.95);

    const double aside = 0.08;
    const Score beside =
        score_skeleton(subject, file_of({{aside, 0, -0.8}, {aside, 0, 0.8}}, {{0, 1}}), nullptr);
    double expected = 0.0;
    for (int i = 0; i < 24; ++i) {
        const double angle = std::numbers::pi * i / 24;
        const double across = aside * std::sin(angle);
        expected +=
            aside * std::abs(std::cos(angle)) / std::sqrt(radius * radius - across * across);
    }
    CHECK(*beside.off_centre_median == doctest::Approx(expected / 24).epsilon(0.01));
    CHECK(*beside.reconstruction > *axis.reconstruction);
}

TEST_CASE("score: the balls along a sphere's centre rebuild it") {
    const Subject subject(test::sphere(0.5, 4));
    const Score score = score_skeleton(subject, file_of({{0, 0, 0}}, {}), nullptr);
    CHECK(score.inside == 1.0);
    CHECK(*score.reconstruction < 0.002);
    CHECK(!score.off_centre_median);
    CHECK(*score.cover_p95 < 1.2);
}

TEST_CASE("score: half of a line that leaves the model is inside") {
    const Subject subject(test::cube());
    const Score score =
        score_skeleton(subject, file_of({{0, 0, 0}, {1, 0.013, 0.021}}, {{0, 1}}), nullptr);
    CHECK(score.inside == doctest::Approx(0.5).epsilon(0.005));
}

TEST_CASE("score: parts are held against solids, cycles against handles") {
    const Subject subject(test::torus());
    const SkeletonFile ring = file_of({{0.35, 0, 0}, {0, 0.35, 0}, {-0.35, 0, 0}, {0, -0.35, 0}},
                                      {{0, 1}, {0, 3}, {1, 2}, {2, 3}});
    CHECK(score_skeleton(subject, ring, nullptr).is_topology_right());
    SkeletonFile open = ring;
    open.graph.edges.pop_back();
    CHECK(!score_skeleton(subject, open, nullptr).is_topology_right());
    const Subject hollow(
        test::together(test::sphere(0.5, 2), test::turned_inside_out(test::sphere(0.3, 2))));
    CHECK(hollow.expected_components() == 1);
    CHECK(!hollow.is_inside(DVec3(0.0)));
}

TEST_CASE("count_spurs: an end branch within the ball of its inner end is one") {
    const Subject subject(test::sphere(1.0, 3));
    const double in_diagonals = subject.surface().world_from_model.scale;
    const auto spurs = [&](double length) {
        SkeletonGraph graph = graph_of({{0, 0, 0}, {0.5, 0, 0}, {-0.5, 0, 0}, {0, length, 0}},
                                       {{0, 1}, {0, 2}, {0, 3}});
        for (SkeletonGraph::Node& node : graph.nodes) node.position *= in_diagonals;
        return count_spurs(subject, graph, find_branches(graph));
    };
    CHECK(spurs(0.9) == 3);
    CHECK(spurs(1.1) == 2);
}

TEST_CASE("mean_turn_deg: one right angle in ten steps") {
    const SkeletonGraph graph =
        graph_of({{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.05, 0}}, {{0, 1}, {1, 2}});
    CHECK(*mean_turn_deg(graph, find_branches(graph)) == doctest::Approx(10.0));
}

TEST_CASE("compare_curves: two parallel lines are as far apart as they are") {
    const Subject subject(test::cube());
    const SkeletonGraph a = graph_of({{0, 0, 0}, {0.4, 0, 0}}, {{0, 1}});
    const SkeletonGraph b = graph_of({{0, 0.1, 0}, {0.4, 0.1, 0}}, {{0, 1}});
    const SkeletonDistance distance = compare_curves(subject, a, b);
    CHECK(distance.mean == doctest::Approx(0.1 / std::sqrt(3.0)));
    CHECK(distance.hausdorff == doctest::Approx(0.1 / std::sqrt(3.0)));
    CHECK(compare_curves(subject, a, a).hausdorff == doctest::Approx(0.0));
}

TEST_CASE("read_skeleton: objects or arrays, edges once; what is wrong is told with the path") {
    const SkeletonFile plain = read_skeleton(written(
        "zskel_score_plain.json", R"({"nodes":[[0,0,0],[1,0,0]],"edges":[[1,0],[0,1],[0,0]]})"));
    CHECK(plain.graph.edges.size() == 1);
    CHECK(!plain.has_radii);
    const SkeletonFile named = read_skeleton(written(
        "zskel_score_named.json",
        R"({"nodes":[{"id":7,"position":[0,0,0],"radius":1},{"id":9,"position":[0,2,0],"radius":3}],
            "edges":[{"source":9,"target":7}]})"));
    CHECK(named.has_radii);
    CHECK(named.graph.nodes[1].radius == 3.0);
    const std::string bad =
        written("zskel_score_bad.json", R"({"nodes":[[0,0,0]],"edges":[[0,3]]})");
    CHECK_THROWS_WITH_AS(read_skeleton(bad), (bad + ": there is no node 3").c_str(), InputError);
    CHECK_THROWS_AS(read_skeleton("/nowhere.json"), InputError);
}

TEST_CASE("the table counts what is wrong; a model that failed is a row") {
    const Subject subject(test::cylinder(0.2, 2.0));
    Row good{"good <1>", "", {}, ""};
    good.score = score_skeleton(subject, file_of({{0, 0, -0.8}, {0, 0, 0.8}}, {{0, 1}}), nullptr);
    CHECK(totals_of({good}).are_zero());
    const std::vector<Row> rows{good, {"bad", "exit 3: not a mesh", {}, ""}};
    CHECK(totals_of(rows).failed == 1);
    const auto json = nlohmann::json::parse(table_json(rows));
    CHECK(json["models"].size() == 2);
    CHECK(json["models"][1]["failure"] == "exit 3: not a mesh");
    CHECK(json["models"][0]["missed"].is_null());
    CHECK(json["medians"]["nodes"] == 2.0);
    CHECK(table_text(rows).find("failed: exit 3") != std::string::npos);
    const std::string page = page_html(rows, "a & b", "no GL");
    CHECK(page.find("good &lt;1&gt;") != std::string::npos);
    CHECK(page.find("There are no pictures: no GL") != std::string::npos);
    CHECK(page == page_html(rows, "a & b", "no GL"));
}
