// What must hold of any mesh, tried on random ones: the skeleton is the shape's, not that of its
// coordinates, its numbering or its triangles.
#include <doctest/doctest.h>

#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/read_mesh.h"

using namespace zskel;

namespace {

// The same cases in every run; RC_PARAMS set from outside gives others.
const bool is_seeded = setenv("RC_PARAMS", "seed=1 max_success=10 noshrink=1", 0) == 0;

constexpr int kFacePx = 6;
constexpr int kPlaces = 8;  // looked at along an edge

struct Shape {
    Mesh mesh;
    double diagonal = 0.0;
    ExtractResult plain;
};

Shape shape_of(Mesh mesh) {
    Box box;
    for (const DVec3& p : mesh.positions) box.add(p);
    ExtractResult plain = test::extract(mesh, {}, kFacePx);
    return {std::move(mesh), box.diagonal(), std::move(plain)};
}

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = [] {
        std::vector<Shape> out;
        out.push_back(shape_of(test::torus(0.35, 0.12, 20, 10)));
        out.push_back(shape_of(read_mesh(ZSKEL_MODELS "/y.obj")));
        return out;
    }();
    return all;
}

// Places along a skeleton; its nodes where it has no edges.
std::vector<DVec3> places_of(const SkeletonGraph& graph) {
    std::vector<DVec3> out;
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        for (int k = 0; k < kPlaces; ++k)
            out.push_back(glm::mix(graph.nodes[edge.source].position,
                                   graph.nodes[edge.target].position, (k + 0.5) / kPlaces));
    }
    for (const SkeletonGraph::Node& node : graph.nodes) out.push_back(node.position);
    return out;
}

double mean_distance(const std::vector<DVec3>& from, const std::vector<DVec3>& to) {
    double sum = 0.0;
    for (const DVec3& p : from) {
        double least = std::numeric_limits<double>::infinity();
        for (const DVec3& q : to) least = std::min(least, glm::distance(p, q));
        sum += least;
    }
    return sum / static_cast<double>(from.size());
}

std::size_t count_of_degree(const SkeletonGraph& graph, std::uint32_t degree) {
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    return static_cast<std::size_t>(std::count(degrees.begin(), degrees.end(), degree));
}

// One skeleton: components, cycles and ends, and in the mean no farther apart, either way, than a
// share of the shape's diagonal.
void expect_same(const Shape& shape, const SkeletonGraph& graph, double diagonals) {
    const SkeletonGraph& plain = shape.plain.graph;
    RC_ASSERT(graph_topology(graph).components == graph_topology(plain).components);
    RC_ASSERT(graph_topology(graph).cycles == graph_topology(plain).cycles);
    RC_ASSERT(count_of_degree(graph, 1) == count_of_degree(plain, 1));
    const std::vector<DVec3> a = places_of(graph);
    const std::vector<DVec3> b = places_of(plain);
    const double apart = std::max(mean_distance(a, b), mean_distance(b, a)) / shape.diagonal;
    RC_LOG() << "mean distance " << apart << " diagonals";
    RC_ASSERT(apart <= diagonals);
}

const Shape& any_shape() {
    return shapes()[*rc::gen::inRange<std::size_t>(0, shapes().size())];
}

double any_share() {
    return *rc::gen::inRange(0, 1000) / 1000.0;
}

glm::dquat any_turn() {
    const DVec3 axis(any_share() - 0.5, any_share() - 0.5, any_share() + 0.001);
    return glm::angleAxis(2.0 * std::numbers::pi * any_share(), glm::normalize(axis));
}

std::vector<std::uint32_t> any_order(std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
    return order;
}

// `corner` makes every corner's number a new one.
template <typename Corner>
Mesh renumbered(const Mesh& mesh, std::vector<DVec3> positions, Corner corner) {
    Mesh out;
    out.name = mesh.name;
    out.positions = std::move(positions);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        test::add_triangle(out, corner(t, old, 0), corner(t, old, 1), corner(t, old, 2));
    }
    return out;
}

Mesh shuffled(const Mesh& mesh, const std::vector<std::uint32_t>& order) {
    std::vector<DVec3> positions(mesh.positions.size());
    for (std::size_t v = 0; v < order.size(); ++v) positions[order[v]] = mesh.positions[v];
    return renumbered(mesh, positions,
                      [&](std::uint32_t, const Triangle& t, int k) { return order[t[k]]; });
}

// No two triangles share a vertex.
Mesh soup(const Mesh& mesh) {
    std::vector<DVec3> positions;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) positions.push_back(mesh.positions[t[k]]);
    }
    return renumbered(mesh, positions, [](std::uint32_t t, const Triangle&, int k) {
        return 3 * t + static_cast<std::uint32_t>(k);
    });
}

// A new vertex within some triangles, each of which becomes three.
Mesh split(const Mesh& mesh, const std::vector<bool>& is_split, double first, double second) {
    Mesh out;
    out.name = mesh.name;
    out.positions = mesh.positions;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& old = mesh.triangles[t];
        if (!is_split[t]) {
            test::add_triangle(out, old.x, old.y, old.z);
            continue;
        }
        const auto middle = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[old.x] * first + mesh.positions[old.y] * second +
                                mesh.positions[old.z] * (1.0 - first - second));
        for (int k = 0; k < 3; ++k) test::add_triangle(out, old[k], old[(k + 1) % 3], middle);
    }
    return out;
}

}  // namespace

TEST_CASE("property: turned, moved and scaled models have skeletons turned, moved and scaled") {
    CHECK(rc::check([] {
        const Shape& shape = any_shape();
        const glm::dquat turn = any_turn();
        const double scale = std::pow(10.0, 12.0 * any_share() - 6.0);
        const DVec3 shift = DVec3(any_share(), any_share(), any_share()) * (100.0 * scale);
        Mesh mesh = shape.mesh;
        for (DVec3& p : mesh.positions) p = turn * p * scale + shift;
        SkeletonGraph graph = test::extract(mesh, {}, kFacePx).graph;
        for (SkeletonGraph::Node& node : graph.nodes)
            node.position = glm::conjugate(turn) * ((node.position - shift) / scale);
        expect_same(shape, graph, 0.005);
    }));
}

TEST_CASE("property: the order of vertices and triangles does not matter") {
    CHECK(rc::check([] {
        const Shape& shape = any_shape();
        Mesh mesh = shuffled(shape.mesh, any_order(shape.mesh.positions.size()));
        const std::vector<std::uint32_t> order = any_order(mesh.triangles.size());
        std::vector<Triangle> triangles;
        for (const std::uint32_t t : order) triangles.push_back(mesh.triangles[t]);
        mesh.triangles = triangles;
        expect_same(shape, test::extract(mesh, {}, kFacePx).graph, 0.005);
    }));
}

TEST_CASE("property: a soup of triangles is the surface it makes up") {
    CHECK(rc::check([] {
        const Shape& shape = any_shape();
        const Mesh loose = soup(shape.mesh);
        const Mesh mesh = shuffled(loose, any_order(loose.positions.size()));
        const ExtractResult result = test::extract(mesh, {}, kFacePx);
        RC_ASSERT(result.statistics.vertices == shape.mesh.positions.size());
        expect_same(shape, result.graph, 0.005);
    }));
}

TEST_CASE("property: triangles split in three change no topology, and the skeleton little") {
    CHECK(rc::check([] {
        const Shape& shape = any_shape();
        std::vector<bool> is_split;
        for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t)
            is_split.push_back(*rc::gen::inRange(0, 4) == 0);
        const double first = 0.1 + 0.4 * any_share();
        const Mesh mesh = split(shape.mesh, is_split, first, 0.8 - first);
        expect_same(shape, test::extract(mesh, {}, kFacePx).graph, 0.01);
    }));
}

TEST_CASE("property: faces that are missing are made up for") {
    CHECK(rc::check([] {
        const Shape& shape = any_shape();
        Mesh mesh = shape.mesh;
        for (int holes = *rc::gen::inRange(1, 4); holes > 0; --holes) {
            const auto at = *rc::gen::inRange<std::size_t>(0, mesh.triangles.size());
            mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(at));
        }
        ExtractOptions options;
        options.repair.has_caps = true;
        const ExtractResult result = test::extract(mesh, options, kFacePx);
        RC_ASSERT(result.statistics.openings > 0u);
        expect_same(shape, result.graph, 0.01);
    }));
}
