// Any bytes as a skeleton of one format, which ZSKEL_FUZZ_FORMAT names. What was read is written in
// every format, and read again where that format is read.
#include <algorithm>
#include <array>
#include <set>

#include "fuzz.h"
#include "zskel/io/skeleton_formats.h"

using namespace zskel;

namespace {

bool is_same(const SkeletonGraph& a, const SkeletonGraph& b) {
    const auto same_node = [](const SkeletonGraph::Node& l, const SkeletonGraph::Node& r) {
        return l.position == r.position;
    };
    const auto same_edge = [](const SkeletonGraph::Edge& l, const SkeletonGraph::Edge& r) {
        return l.source == r.source && l.target == r.target;
    };
    return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node) &&
           std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge);
}

// CGAL's form knows nodes by their places only.
bool is_kept_by(SkeletonFormat format, const SkeletonGraph& graph) {
    if (format != SkeletonFormat::Polylines) return true;
    std::set<std::array<double, 3>> places;
    for (const SkeletonGraph::Node& node : graph.nodes)
        places.insert({node.position.x, node.position.y, node.position.z});
    return places.size() == graph.nodes.size();
}

// CGAL's form numbers nodes by its lines, SWC by its trees.
bool keeps_numbers(SkeletonFormat format) {
    return format != SkeletonFormat::Polylines && format != SkeletonFormat::Swc;
}

void check(const SkeletonGraph& graph) {
    for (const SkeletonFormatInfo& info : skeleton_formats()) {
        const std::string bytes = write_skeleton(graph, info.format);
        if (!info.is_readable || !is_kept_by(info.format, graph)) continue;
        const SkeletonFile again = parse_skeleton(bytes, info.format, "written");
        fuzz::require(again.graph.edges.size() == graph.edges.size(), "every edge is kept");
        if (keeps_numbers(info.format))
            fuzz::require(is_same(graph, again.graph), "what was written is what is read");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::answer([&] {
        const SkeletonFile file = parse_skeleton(fuzz::text_of(data, size),
                                                 SkeletonFormat::ZSKEL_FUZZ_FORMAT, "skeleton");
        try {
            check(file.graph);
        } catch (const InputError& error) {
            fuzz::require(false, error.what());
        }
    });
    return 0;
}
