#include "scoring/curve.h"

#include <algorithm>
#include <cmath>

#include "zskel/core/parallel.h"

namespace zskel::scoring {
namespace {

std::uint32_t edge_between(const SkeletonGraph& graph, std::uint32_t a, std::uint32_t b) {
    const auto before = [](const SkeletonGraph::Edge& l, const SkeletonGraph::Edge& r) {
        return l.source != r.source ? l.source < r.source : l.target < r.target;
    };
    const auto at = std::lower_bound(graph.edges.begin(), graph.edges.end(),
                                     SkeletonGraph::Edge{std::min(a, b), std::max(a, b)}, before);
    return static_cast<std::uint32_t>(at - graph.edges.begin());
}

Piece piece(const SkeletonGraph& graph, std::uint32_t a, std::uint32_t b) {
    const SkeletonGraph::Node& from = graph.nodes[a];
    const SkeletonGraph::Node& to = graph.nodes[b];
    return {from.position, to.position, from.radius, to.radius};
}

Foot foot_on(const Piece& piece, const DVec3& point) {
    const DVec3 along = piece.b - piece.a;
    const double length2 = glm::dot(along, along);
    const double share =
        length2 > 0.0 ? std::clamp(glm::dot(point - piece.a, along) / length2, 0.0, 1.0) : 0.0;
    return {glm::distance(point, piece.a + share * along),
            glm::mix(piece.radius_a, piece.radius_b, share)};
}

}  // namespace

std::vector<CurveSample> sample_curve(const SkeletonGraph& graph, double spacing) {
    std::vector<CurveSample> out;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
        const DVec3& a = graph.nodes[graph.edges[e].source].position;
        const DVec3& b = graph.nodes[graph.edges[e].target].position;
        const double length = glm::distance(a, b);
        const double parts = std::max(1.0, std::ceil(length / spacing));
        for (double i = 0.5; i < parts; i += 1.0)
            out.push_back({glm::mix(a, b, i / parts), e, length / parts});
    }
    if (graph.edges.empty()) {
        for (const SkeletonGraph::Node& node : graph.nodes)
            out.push_back({node.position, kNone, 1.0});
    }
    return out;
}

std::vector<CurveSample> resample_branch(const SkeletonGraph& graph, const Branch& branch,
                                         double step) {
    const double steps = std::ceil(branch.length / step);
    std::vector<CurveSample> out{{graph.nodes[branch.nodes[0]].position,
                                  edge_between(graph, branch.nodes[0], branch.nodes[1]), 0.0}};
    double done = 0.0;  // length up to the node at i - 1
    double next = 1.0;  // number of the next point
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
        const DVec3& a = graph.nodes[branch.nodes[i - 1]].position;
        const DVec3& b = graph.nodes[branch.nodes[i]].position;
        const std::uint32_t edge = edge_between(graph, branch.nodes[i - 1], branch.nodes[i]);
        const double length = glm::distance(a, b);
        for (; next < steps && next / steps * branch.length <= done + length; next += 1.0) {
            const double share = (next / steps * branch.length - done) / length;
            out.push_back({glm::mix(a, b, share), edge, 0.0});
        }
        done += length;
        if (i + 1 == branch.nodes.size() && steps > 0.0) out.push_back({b, edge, 0.0});
    }
    return out;
}

std::vector<Piece> pieces_of(const SkeletonGraph& graph) {
    std::vector<Piece> out;
    for (const SkeletonGraph::Edge& edge : graph.edges)
        out.push_back(piece(graph, edge.source, edge.target));
    const std::vector<std::uint32_t> degrees = node_degrees(graph);
    for (std::uint32_t n = 0; n < degrees.size(); ++n) {
        if (degrees[n] == 0) out.push_back(piece(graph, n, n));
    }
    return out;
}

std::vector<Piece> pieces_along(const SkeletonGraph& graph, std::span<const std::uint32_t> nodes) {
    std::vector<Piece> out;
    for (std::size_t i = 1; i < nodes.size(); ++i)
        out.push_back(piece(graph, nodes[i - 1], nodes[i]));
    if (nodes.size() == 1) out.push_back(piece(graph, nodes[0], nodes[0]));
    return out;
}

Foot nearest_foot(std::span<const Piece> pieces, const DVec3& point) {
    Foot best;
    for (const Piece& piece : pieces) {
        const Foot foot = foot_on(piece, point);
        if (foot.distance < best.distance) best = foot;
    }
    return best;
}

double radii_away(std::span<const Piece> pieces, const DVec3& point) {
    double best = kInfinity;
    for (const Piece& piece : pieces) {
        const Foot foot = foot_on(piece, point);
        if (foot.radius > 0.0) best = std::min(best, foot.distance / foot.radius);
    }
    return best;
}

std::vector<double> distances_to(std::span<const Piece> pieces, std::span<const DVec3> points) {
    std::vector<double> out(points.size());
    parallel_for(points.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out[i] = nearest_foot(pieces, points[i]).distance;
    });
    return out;
}

CurveDistance distance_between(std::span<const CurveSample> from, std::span<const Piece> to) {
    std::vector<DVec3> points;
    for (const CurveSample& sample : from) points.push_back(sample.position);
    const std::vector<double> distances = distances_to(to, points);
    double sum = 0.0;
    double weight = 0.0;
    CurveDistance out;
    out.largest = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        sum += distances[i] * from[i].weight;
        weight += from[i].weight;
        out.largest = std::max(out.largest, distances[i]);
    }
    out.mean = weight > 0.0 ? sum / weight : kInfinity;
    return out;
}

}  // namespace zskel::scoring
