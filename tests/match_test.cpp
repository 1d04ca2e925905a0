#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "zskel/core/error.h"
#include "zskel/io/dendrogram.h"
#include "zskel/io/signature_file.h"
#include "zskel/match/assignment.h"
#include "zskel/match/signature.h"

using namespace zskel;

namespace {

// A chain of nodes through corners, a tenth of a unit apart; balls of `radius` all along.
void add_line(SkeletonGraph& graph, std::uint32_t from, const std::vector<DVec3>& corners,
              double radius) {
    for (const DVec3& corner : corners) {
        const DVec3 start = graph.nodes[from].position;
        const int steps = static_cast<int>(std::lround(10.0 * glm::distance(start, corner)));
        for (int i = 1; i <= steps; ++i) {
            const auto next = static_cast<std::uint32_t>(graph.nodes.size());
            graph.nodes.push_back(
                {glm::mix(start, corner, i / static_cast<double>(steps)), radius, 0, 0.0});
            graph.edges.push_back({from, next});
            from = next;
        }
    }
}

// A body with two arms, an elbow in each.
SkeletonGraph figure(double elbow, double scale = 1.0, double arm = 2.0) {
    SkeletonGraph graph;
    graph.nodes.push_back({DVec3(0.0), 0.3, 0, 0.0});
    add_line(graph, 0, {{0, -3, 0}}, 0.3);
    for (const double side : {-1.0, 1.0}) {
        const DVec3 middle(side * 0.5 * arm, 0, 0);
        const DVec3 hand = middle + 0.5 * arm * DVec3(side * std::cos(elbow), std::sin(elbow), 0);
        add_line(graph, 0, {middle, hand}, 0.1);
    }
    for (SkeletonGraph::Node& node : graph.nodes) {
        node.position = scale * DVec3(node.position.z + 7.0, node.position.x, node.position.y);
        node.radius *= scale;
    }
    return graph;
}

}  // namespace

TEST_CASE("cheapest_assignment: as cheap as the best of all permutations, each column once") {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> cost_of(0, 20);  // with ties
    for (std::size_t n = 1; n <= 6; ++n) {
        for (int round = 0; round < 60; ++round) {
            std::vector<double> cost(n * n);
            for (double& c : cost) c = cost_of(random);
            const auto sum = [&](const std::vector<std::uint32_t>& column) {
                double total = 0.0;
                for (std::size_t r = 0; r < n; ++r) total += cost[r * n + column[r]];
                return total;
            };
            std::vector<std::uint32_t> order(n);
            std::iota(order.begin(), order.end(), 0u);
            double least = std::numeric_limits<double>::infinity();
            do {
                least = std::min(least, sum(order));
            } while (std::next_permutation(order.begin(), order.end()));
            const std::vector<std::uint32_t> found = cheapest_assignment(cost, n);
            CHECK(std::set<std::uint32_t>(found.begin(), found.end()).size() == n);
            CHECK(sum(found) == doctest::Approx(least));
        }
    }
}

TEST_CASE("match_signatures: nothing lies between a shape and itself, moved, scaled or bent") {
    const Signature straight = signature_of(figure(0.0));
    REQUIRE(straight.size() == kStations);
    const Match same = match_signatures(straight, straight);
    CHECK(same.distance == 0.0);
    CHECK(match_signatures(straight, signature_of(figure(0.0, 1000.0))).distance < 1e-4);
    CHECK(match_signatures(straight, signature_of(figure(1.2))).distance < 0.01);
}

TEST_CASE("match_signatures: longer arms are farther than bent ones, and both ways alike") {
    const Signature one = signature_of(figure(0.0));
    const Signature longer = signature_of(figure(0.0, 1.0, 3.0));
    const double apart = match_signatures(one, longer).distance;
    CHECK(apart > 10.0 * match_signatures(one, signature_of(figure(1.2))).distance);
    CHECK(match_signatures(longer, one).distance == doctest::Approx(apart));
}

TEST_CASE("match_signatures: hands are matched with hands, the foot with the foot") {
    const SkeletonGraph straight = figure(0.0);
    const SkeletonGraph crooked = figure(1.0, 2.0);
    const Signature a = signature_of(straight);
    const Signature b = signature_of(crooked);
    const Match match = match_signatures(a, b);
    std::size_t thin = 0;
    for (std::size_t s = 0; s < a.size(); ++s) {
        const double here = straight.nodes[a[s].node].radius;
        const double there = crooked.nodes[b[match.other[s]].node].radius / 2.0;
        thin += here < 0.2 ? 1 : 0;
        CHECK(here == doctest::Approx(there));
    }
    CHECK(thin > kStations / 3);
}

TEST_CASE("signature_of: stored volumes count, parts apart are no error, nothing is") {
    SkeletonGraph graph = figure(0.0);
    const Signature by_radius = signature_of(graph);
    for (SkeletonGraph::Node& node : graph.nodes) node.volume = node.radius > 0.2 ? 1.0 : 0.0;
    CHECK(match_signatures(by_radius, signature_of(graph)).distance > 0.05);
    const auto first = static_cast<std::uint32_t>(graph.nodes.size());
    graph.nodes.push_back({{50, 0, 0}, 0.2, 1, 0.0});
    graph.nodes.push_back({{50, 1, 0}, 0.2, 1, 0.0});
    graph.edges.push_back({first, first + 1});
    for (const Station& station : signature_of(graph)) {
        for (const float way : station.by_length) CHECK(std::isfinite(way));
    }
    SkeletonGraph dot;
    dot.nodes.push_back({DVec3(0.0), 1.0, 0, 0.0});
    CHECK(match_signatures(signature_of(dot), signature_of(dot)).distance == 0.0);
    dot.nodes[0].radius = 0.0;
    CHECK_THROWS_AS(signature_of(dot), InputError);
    CHECK_THROWS_AS(signature_of(SkeletonGraph{}), InputError);
}

TEST_CASE("dendrogram_svg: those nearest to each other are joined first and stand side by side") {
    const std::vector<std::vector<double>> distances{
        {0, 8, 1, 9}, {8, 0, 7, 2}, {1, 7, 0, 8}, {9, 2, 8, 0}};
    const std::string svg = dendrogram_svg({"a<b", "c&d", "e", "f"}, distances);
    const std::array<std::size_t, 4> at{svg.find(">a&lt;b<"), svg.find(">e<"),
                                        svg.find(">c&amp;d<"), svg.find(">f<")};
    CHECK(std::is_sorted(at.begin(), at.end()));
    CHECK(at.back() != std::string::npos);
    // Average linkage: the pairs at 1 and 2, both at the mean of 8, 9, 7 and 8.
    const auto join = [](double height) {
        return fmt::format("H{:.1f}V", 12.0 + 480.0 * (1.0 - height / 8.0));
    };
    const std::array<std::size_t, 3> joins{svg.find(join(1)), svg.find(join(2)), svg.find(join(8))};
    CHECK(std::is_sorted(joins.begin(), joins.end()));
    CHECK(joins.back() != std::string::npos);
    CHECK(dendrogram_svg({"alone"}, {{0}}).find(">alone<") != std::string::npos);
    CHECK_THROWS_AS(dendrogram_svg({}, {}), UsageError);
}

TEST_CASE("index of shapes: what was written comes back, what is damaged is refused") {
    std::vector<NamedSignature> shapes;
    for (const char* name : {"a.json", "", "folder, with \"marks\".json"})
        shapes.push_back({name, signature_of(figure(0.0, shapes.empty() ? 1.0 : 2.0))});
    const std::string bytes = write_signatures(shapes);
    const std::vector<NamedSignature> back = read_signatures(bytes, "a.idx");
    REQUIRE(back.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(back[i].name == shapes[i].name);
        CHECK(match_signatures(back[i].signature, shapes[i].signature).distance < 1e-7);
        for (std::size_t s = 0; s < kStations; ++s)
            CHECK(back[i].signature[s].node == shapes[i].signature[s].node);
    }
    CHECK(write_signatures(back) == bytes);
    CHECK(read_signatures(write_signatures({}), "b.idx").empty());
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 7)
        CHECK_THROWS_AS(read_signatures(bytes.substr(0, size), "cut"), InputError);
    CHECK_THROWS_WITH_AS(read_signatures(bytes + "x", "long"), doctest::Contains("1 bytes after"),
                         InputError);
    const auto damaged = [&](std::size_t at, char value, const char* piece) {
        std::string other = bytes;
        other[at] = value;
        CHECK_THROWS_WITH_AS(read_signatures(other, "bad.idx"), doctest::Contains(piece),
                             InputError);
    };
    damaged(0, 'Z', "bad.idx: no index of shapes");
    damaged(8, 2, "bad.idx: byte 8: version 2");
    damaged(12, 1, "stations");
    damaged(20, 4, "byte 20: 4 shapes");
    damaged(23, 4, "shapes cannot be held");
    damaged(27, 4, "a name of");
    damaged(24 + 4 + 6 + 4 + 3, static_cast<char>(0xff), "is not a length");
}
