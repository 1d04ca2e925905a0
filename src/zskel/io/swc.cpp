// SWC after R. Cannon et al., "An on-line archive of reconstructed hippocampal neurons", 1998: a
// line for each sample with id, type, x, y, z, radius and the parent's id, parents first, -1 for a
// root. A skeleton with cycles is no tree; each cycle is opened at its longest edge, which a
// comment names.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "zskel/core/disjoint_sets.h"
#include "zskel/io/format_io.h"
#include "zskel/mesh/text_cursor.h"

namespace zskel {
namespace {

// What the types 5 and 6 mean where files have them at all.
constexpr int kUndefined = 0;
constexpr int kForkPoint = 5;
constexpr int kEndPoint = 6;

struct Forest {
    NodeLinks links;
    std::vector<std::uint32_t> roots;       ///< of each tree its node of largest radius
    std::vector<SkeletonGraph::Edge> cuts;  ///< edges that are in no tree
};

/// The trees of least length: an edge that is left out is the longest of the cycle that it closes.
Forest cut_cycles(const SkeletonGraph& graph) {
    std::vector<double> lengths;
    for (const SkeletonGraph::Edge& e : graph.edges)
        lengths.push_back(
            glm::distance(graph.nodes[e.source].position, graph.nodes[e.target].position));
    std::vector<std::size_t> order(graph.edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t l, std::size_t r) { return lengths[l] < lengths[r]; });
    Forest forest;
    forest.links.resize(graph.nodes.size());
    DisjointSets sets(graph.nodes.size());
    for (const std::size_t i : order) {
        const SkeletonGraph::Edge& e = graph.edges[i];
        if (!sets.unite(e.source, e.target)) {
            forest.cuts.push_back(e);
            continue;
        }
        forest.links[e.source].push_back(e.target);
        forest.links[e.target].push_back(e.source);
    }
    std::vector<std::uint32_t> largest(graph.nodes.size(), kNone);
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        std::uint32_t& root = largest[sets.find(n)];
        if (root == kNone || graph.nodes[n].radius > graph.nodes[root].radius) root = n;
    }
    std::copy_if(largest.begin(), largest.end(), std::back_inserter(forest.roots),
                 [](std::uint32_t root) { return root != kNone; });
    return forest;
}

struct Sample {
    std::uint32_t node;
    std::int64_t parent;  ///< its id: its place in the list + 1; -1 at roots
};

/// Every node once, branch by branch, parents first.
std::vector<Sample> list_samples(Forest& forest) {
    std::vector<Sample> samples;
    for (const std::uint32_t root : forest.roots) {
        std::vector<Sample> open{{root, -1}};
        while (!open.empty()) {
            const Sample sample = open.back();
            open.pop_back();
            samples.push_back(sample);
            const auto id = static_cast<std::int64_t>(samples.size());
            const std::uint32_t from =
                sample.parent < 0 ? kNone
                                  : samples[static_cast<std::size_t>(sample.parent) - 1].node;
            std::vector<std::uint32_t>& links = forest.links[sample.node];
            std::sort(links.rbegin(), links.rend());
            for (const std::uint32_t next : links)
                if (next != from) open.push_back({next, id});
        }
    }
    return samples;
}

int type_of(std::size_t degree) {
    if (degree == 1) return kEndPoint;
    return degree > 2 ? kForkPoint : kUndefined;
}

class SwcReader {
  public:
    SwcReader(std::string_view bytes, const std::string& name) : text_(bytes, name), name_(name) {}

    SkeletonFile read() {
        while (text_.to_content()) {
            if (text_.peek_word().front() == '#') {
                read_comment();
            } else {
                read_sample();
            }
        }
        join(links_);
        join(cuts_);
        return builder_.finish(true, name_);
    }

  private:
    struct Link {
        std::int64_t from;
        std::int64_t to;
        TextCursor place;
    };

    // Our own cuts are healed; every other comment is left out.
    void read_comment() {
        const TextCursor place = text_;
        if (text_.word() != "#" || text_.word() != "cut") return text_.next_line();
        const std::int64_t from = text_.integer("sample at the cut");
        const std::int64_t to = text_.integer("sample at the cut");
        text_.end_line("the cut");
        cuts_.push_back({from, to, place});
    }

    void read_sample() {
        const TextCursor place = text_;
        const std::int64_t id = text_.integer("sample id");
        text_.integer("type");
        SkeletonGraph::Node node;
        node.position.x = text_.finite_number("coordinate x");
        node.position.y = text_.finite_number("coordinate y");
        node.position.z = text_.finite_number("coordinate z");
        node.radius = text_.finite_number("radius");
        const std::int64_t parent = text_.integer("parent");
        if (!numbers_.try_emplace(id, numbers_.size()).second)
            place.fail(fmt::format("a second sample of the id {}", id));
        check(place, builder_.add_node(node));
        if (parent != -1) links_.push_back({id, parent, place});
        text_.end_line("the sample");
    }

    void join(const std::vector<Link>& links) {
        for (const Link& link : links)
            check(link.place, builder_.add_edge(number_of(link.from, link.place),
                                                number_of(link.to, link.place)));
    }

    std::int64_t number_of(std::int64_t id, const TextCursor& place) const {
        const auto found = numbers_.find(id);
        if (found == numbers_.end()) place.fail(fmt::format("no sample has the id {}", id));
        return static_cast<std::int64_t>(found->second);
    }

    static void check(const TextCursor& place, const std::string& complaint) {
        if (!complaint.empty()) place.fail(complaint);
    }

    TextCursor text_;
    std::string name_;
    SkeletonBuilder builder_;
    std::unordered_map<std::int64_t, std::size_t> numbers_;
    std::vector<Link> links_;
    std::vector<Link> cuts_;
};

}  // namespace

std::string write_swc(const SkeletonGraph& graph, const std::string& origin) {
    Forest forest = cut_cycles(graph);
    const std::vector<Sample> samples = list_samples(forest);
    std::vector<std::size_t> ids(graph.nodes.size());
    for (std::size_t i = 0; i < samples.size(); ++i) ids[samples[i].node] = i + 1;
    std::vector<std::size_t> roots;
    for (const std::uint32_t root : forest.roots) roots.push_back(ids[root]);
    std::string text = fmt::format(
        "# {}\n# units: those of the model, not micrometres\n"
        "# roots: the node of largest radius of each component: {}\n"
        "# types: 5 fork point, 6 end point, 0 any other\n"
        "# cycles: {} opened, each at its longest edge, whose ends are named by 'cut'\n",
        origin, fmt::join(roots, " "), forest.cuts.size());
    for (const SkeletonGraph::Edge& cut : forest.cuts)
        text += fmt::format("# cut {} {}\n", ids[cut.source], ids[cut.target]);
    text += "# id type x y z radius parent\n";
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SkeletonGraph::Node& node = graph.nodes[samples[i].node];
        text += fmt::format("{} {} {} {} {} {} {}\n", i + 1,
                            type_of(forest.links[samples[i].node].size()), node.position.x,
                            node.position.y, node.position.z, node.radius, samples[i].parent);
    }
    return text;
}

SkeletonFile read_swc(std::string_view bytes, const std::string& name) {
    return SwcReader(bytes, name).read();
}

}  // namespace zskel
