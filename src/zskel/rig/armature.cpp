#include "zskel/rig/armature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "zskel/core/error.h"

namespace zskel {
namespace {

constexpr double kCoarser = 1.25;  // each time that there are too many bones
constexpr int kMostCoarser = 30;

// From a root, junction or end of the trees to the next.
struct Chain {
    std::vector<std::uint32_t> nodes;
    std::uint32_t parent = kNone;  // chain
    double length = 0.0;
    bool is_dropped = false;
    std::size_t out = 0;              // the first place in `nodes` that may have a bone
    std::vector<std::size_t> joints;  // places from there on where bones start and end; may be none
    std::uint32_t last_bone = kNone;  // what hangs on its end hangs on this
};

class ArmatureBuilder {
  public:
    ArmatureBuilder(const SkeletonGraph& graph, std::span<const Triangle> triangles,
                    const ArmatureOptions& options)
        : graph_(graph),
          triangles_(triangles),
          options_(options),
          links_(node_links(graph)),
          parents_(graph.nodes.size(), kNone),
          children_(graph.nodes.size()) {
        out_.node_bones.resize(graph.nodes.size());
    }

    Armature build() {
        grow_trees();
        cut_chains();
        leave_shared_patches();
        fit_bones();
        name_branches();
        place_hubs();
        for (Chain& chain : chains_) place_bones(chain);
        note_cuts();
        return std::move(out_);
    }

  private:
    const DVec3& at(std::uint32_t node) const { return graph_.nodes[node].position; }
    double radius(std::uint32_t node) const { return graph_.nodes[node].radius; }

    // Junctions make the best roots, then ends.
    int rank(std::uint32_t node) const {
        return links_[node].size() > 2 ? 2 : links_[node].size() == 1 ? 1 : 0;
    }

    // The shortest ways from the root of each component.
    void grow_trees() {
        std::vector<bool> is_seen(links_.size(), false);
        for (std::uint32_t first = 0; first < links_.size(); ++first) {
            if (is_seen[first]) continue;
            std::vector<std::uint32_t> part{first};
            is_seen[first] = true;
            for (std::size_t i = 0; i < part.size(); ++i) {
                for (const std::uint32_t next : links_[part[i]]) {
                    if (is_seen[next]) continue;
                    is_seen[next] = true;
                    part.push_back(next);
                }
            }
            roots_.push_back(
                *std::max_element(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
                    return rank(a) != rank(b) ? rank(a) < rank(b) : radius(a) < radius(b);
                }));
            grow_tree(roots_.back());
        }
        for (std::uint32_t n = 0; n < parents_.size(); ++n) {
            if (parents_[n] != kNone) children_[parents_[n]].push_back(n);
        }
    }

    void grow_tree(std::uint32_t root) {
        using Entry = std::pair<double, std::uint32_t>;
        ways_.resize(links_.size(), std::numeric_limits<double>::infinity());
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        ways_[root] = 0.0;
        front.emplace(0.0, root);
        while (!front.empty()) {
            const auto [way, n] = front.top();
            front.pop();
            if (way > ways_[n]) continue;
            for (const std::uint32_t next : links_[n]) {
                const double there = way + glm::distance(at(n), at(next));
                if (there >= ways_[next]) continue;
                ways_[next] = there;
                parents_[next] = n;
                front.emplace(there, next);
            }
        }
    }

    bool is_within_branch(std::uint32_t node) const {
        return children_[node].size() == 1 && links_[node].size() == 2;
    }

    // Parents first.
    void cut_chains() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> starts;  // node, chain that ends there
        for (const std::uint32_t root : roots_) starts.emplace_back(root, kNone);
        for (std::size_t i = 0; i < starts.size(); ++i) {
            const std::uint32_t start = starts[i].first;
            const std::uint32_t parent = starts[i].second;
            for (const std::uint32_t child : children_[start]) {
                Chain chain;
                chain.parent = parent;
                chain.nodes = {start, child};
                while (is_within_branch(chain.nodes.back()))
                    chain.nodes.push_back(children_[chain.nodes.back()].front());
                const auto is_out = [&](std::uint32_t n) {
                    return glm::distance(at(n), at(start)) >= radius(start);
                };
                chain.out = static_cast<std::size_t>(
                    std::find_if(chain.nodes.begin(), chain.nodes.end(), is_out) -
                    chain.nodes.begin());
                chain.length = ways_[chain.nodes.back()] - ways_[start];
                starts.emplace_back(chain.nodes.back(), static_cast<std::uint32_t>(chains_.size()));
                chains_.push_back(std::move(chain));
            }
        }
    }

    // Bones start where their chain's patches come away from those of its parent and its siblings.
    void leave_shared_patches() {
        std::vector<std::uint32_t> chain_of(graph_.nodes.size(), kNone);  // junctions: of none
        for (std::uint32_t c = 0; c < chains_.size(); ++c) {
            const std::vector<std::uint32_t>& nodes = chains_[c].nodes;
            for (std::size_t i = 1; i < nodes.size(); ++i) {
                if (i + 1 < nodes.size() || children_[nodes[i]].empty()) chain_of[nodes[i]] = c;
            }
        }
        const auto are_family = [&](std::uint32_t a, std::uint32_t b) {
            return chains_[a].nodes.front() == chains_[b].nodes.front() || chains_[a].parent == b;
        };
        std::vector<bool> is_shared(graph_.nodes.size(), false);
        for (const Triangle& t : triangles_) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t node = graph_.vertex_node[t[k]];
                const std::uint32_t other = graph_.vertex_node[t[(k + 1) % 3]];
                if (node == kNone || other == kNone) continue;
                const std::uint32_t a = chain_of[node];
                const std::uint32_t b = chain_of[other];
                if (a == kNone || b == kNone || a == b) continue;
                if (are_family(a, b)) is_shared[node] = true;
                if (are_family(b, a)) is_shared[other] = true;
            }
        }
        for (Chain& chain : chains_) leave_shared(chain, is_shared);
    }

    // A gap as long as the chain is thick tells that it has come away.
    void leave_shared(Chain& chain, const std::vector<bool>& is_shared) const {
        std::size_t first = chain.out;
        for (std::size_t i = chain.out; i < chain.nodes.size(); ++i) {
            const std::uint32_t n = chain.nodes[i];
            if (first < i && ways_[n] - ways_[chain.nodes[first]] > radius(n)) break;
            if (is_shared[n]) first = i + 1;
        }
        if (first + 1 < chain.nodes.size()) chain.out = first;
    }

    void fit_bones() {
        const std::size_t most = options_.max_bones;
        if (most > 0 && roots_.size() > most) {
            throw UsageError(fmt::format("{} bones are not enough: the skeleton has {} parts", most,
                                         roots_.size()));
        }
        double coarser = 1.0;
        joint_all(coarser);
        for (int i = 0; most > 0 && count_all() > most && i < kMostCoarser; ++i)
            joint_all(coarser *= kCoarser);
        while (most > 0 && count_all() > most) {
            Chain* shortest = nullptr;
            for (std::size_t c = 0; c < chains_.size(); ++c) {
                if (!has_bones(chains_[c]) || carries_[c]) continue;
                if (shortest == nullptr || chains_[c].length < shortest->length)
                    shortest = &chains_[c];
            }
            if (shortest == nullptr) return;
            shortest->is_dropped = true;
            ++out_.dropped_branches;
        }
        out_.stubs = static_cast<std::size_t>(std::ranges::count_if(chains_, [&](const Chain& c) {
            return !c.is_dropped && c.joints.empty() && links_[c.nodes.back()].size() == 1;
        }));
    }

    static bool has_bones(const Chain& chain) { return !chain.is_dropped && !chain.joints.empty(); }

    // Hubs, bones, and an end where none hangs on a chain; notes which chains carry others.
    std::size_t count_all() {
        carries_.assign(chains_.size(), false);
        std::size_t count = roots_.size();
        for (std::size_t c = chains_.size(); c-- > 0;) {
            const Chain& chain = chains_[c];
            if (has_bones(chain)) count += chain.joints.size() - 1 + (carries_[c] ? 0 : 1);
            if (chain.parent != kNone && (has_bones(chain) || carries_[c]))
                carries_[chain.parent] = true;
        }
        return count;
    }

    void joint_all(double coarser) {
        for (Chain& chain : chains_) {
            chain.joints.clear();
            if (chain.out + 1 >= chain.nodes.size()) continue;
            chain.joints.push_back(chain.out);
            bend(chain, chain.out, chain.nodes.size() - 1, coarser);
        }
    }

    // Appends the joints after `first` up to `last` (Douglas and Peucker's way of simplifying
    // lines; then stretches that are too long are split evenly).
    void bend(Chain& chain, std::size_t first, std::size_t last, double coarser) const {
        const DVec3& a = at(chain.nodes[first]);
        const DVec3 chord = at(chain.nodes[last]) - a;
        std::size_t worst = first;
        double most = coarser * options_.bend_radii;
        double thick = 0.0;
        for (std::size_t i = first; i <= last; ++i) {
            const std::uint32_t n = chain.nodes[i];
            thick += radius(n);
            const double square = glm::dot(chord, chord);
            const double share =
                square > 0.0 ? glm::clamp(glm::dot(at(n) - a, chord) / square, 0.0, 1.0) : 0.0;
            const double off =
                glm::distance(at(n), a + chord * share) / std::max(radius(n), 1e-300);
            if (i == first || i == last || off <= most) continue;
            most = off;
            worst = i;
        }
        if (worst != first) {
            bend(chain, first, worst, coarser);
            bend(chain, worst, last, coarser);
            return;
        }
        const double length = ways_[chain.nodes[last]] - ways_[chain.nodes[first]];
        const double longest =
            coarser * options_.longest_radii * thick / static_cast<double>(last - first + 1);
        // No more than there are nodes to end at.
        const auto most_pieces = static_cast<double>(last - first);
        const auto pieces = static_cast<std::size_t>(
            longest > 0.0 ? std::min(std::ceil(length / longest), most_pieces) : most_pieces);
        for (std::size_t piece = 1; piece < pieces; ++piece) {
            const double want = ways_[chain.nodes[first]] +
                                length * static_cast<double>(piece) / static_cast<double>(pieces);
            std::size_t i = chain.joints.back() + 1;
            while (i < last && ways_[chain.nodes[i]] < want) ++i;
            if (i < last) chain.joints.push_back(i);
        }
        chain.joints.push_back(last);
    }

    // A branch that holds a root, or is cut, has several chains.
    void name_branches() {
        const std::vector<Branch> branches = find_branches(graph_);
        for (std::uint32_t b = 0; b < branches.size(); ++b) {
            const std::vector<std::uint32_t>& nodes = branches[b].nodes;
            for (std::size_t i = 1; i < nodes.size(); ++i)
                branch_of_[std::minmax(nodes[i - 1], nodes[i])] = b;
        }
        bones_of_branch_.assign(branches.size(), 0);
    }

    void place_hubs() {
        for (std::size_t r = 0; r < roots_.size(); ++r) {
            out_.node_bones[roots_[r]] = {static_cast<std::uint32_t>(r)};
            const DVec3& place = at(roots_[r]);
            out_.bones.push_back({roots_.size() == 1 ? "root" : fmt::format("root{}", r), kNone,
                                  kNone, place, place, radius(roots_[r])});
        }
    }

    // What hangs on the end of a chain without bones hangs on what the chain hangs on.
    void place_bones(Chain& chain) {
        const std::vector<std::uint32_t>& nodes = chain.nodes;
        chain.last_bone = chain.parent == kNone ? out_.node_bones[nodes.front()].front()
                                                : chains_[chain.parent].last_bone;
        const std::size_t held = has_bones(chain) ? chain.out + 1 : nodes.size();
        for (std::size_t i = 1; i < held; ++i) out_.node_bones[nodes[i]] = {chain.last_bone};
        if (!has_bones(chain)) return;
        const std::uint32_t branch = branch_of_.at(std::minmax(nodes[0], nodes[1]));
        for (std::size_t k = 1; k < chain.joints.size(); ++k) {
            const auto bone = static_cast<std::uint32_t>(out_.bones.size());
            double thick = 0.0;
            for (std::size_t i = chain.joints[k - 1]; i <= chain.joints[k]; ++i) {
                out_.node_bones[nodes[i]].push_back(bone);
                thick += radius(nodes[i]);
            }
            thick /= static_cast<double>(chain.joints[k] - chain.joints[k - 1] + 1);
            out_.bones.push_back({fmt::format("branch{}.{}", branch, bones_of_branch_[branch]++),
                                  chain.last_bone, branch, at(nodes[chain.joints[k - 1]]),
                                  at(nodes[chain.joints[k]]), thick, DVec3(0.0)});
            chain.last_bone = bone;
        }
    }

    void note_cuts() {
        for (const SkeletonGraph::Edge& edge : graph_.edges) {
            if (parents_[edge.source] == edge.target || parents_[edge.target] == edge.source)
                continue;
            out_.cuts.push_back({0.5 * (at(edge.source) + at(edge.target)),
                                 out_.node_bones[edge.source].front(),
                                 out_.node_bones[edge.target].front()});
        }
    }

    const SkeletonGraph& graph_;
    const std::span<const Triangle> triangles_;
    const ArmatureOptions& options_;
    const NodeLinks links_;
    std::vector<std::uint32_t> parents_;  // of nodes, in the trees
    std::vector<std::vector<std::uint32_t>> children_;
    std::vector<std::uint32_t> roots_;  // nodes, one a component
    std::vector<double> ways_;          // of nodes: length from their root
    std::vector<Chain> chains_;
    std::vector<bool> carries_;  // of chains: whether bones hang on its end
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> branch_of_;  // of edges
    std::vector<std::size_t> bones_of_branch_;
    Armature out_;
};

}  // namespace

DVec3 joint_of(const Bone& bone) {
    return bone.head + bone.to_joint;
}

double share_along(const Bone& bone, const DVec3& point) {
    const DVec3 along = bone.tail - bone.head;
    const double square = glm::dot(along, along);
    return square > 0.0 ? glm::dot(point - bone.head, along) / square : 0.0;
}

double distance_to(const Bone& bone, const DVec3& point) {
    const double share = glm::clamp(share_along(bone, point), 0.0, 1.0);
    return glm::distance(point, bone.head + (bone.tail - bone.head) * share);
}

std::vector<std::uint32_t> last_bones(const Armature& armature) {
    std::vector<bool> carries(armature.bones.size(), false);
    for (const Bone& bone : armature.bones) {
        if (bone.parent != kNone) carries[bone.parent] = true;
    }
    std::vector<std::uint32_t> out;
    for (std::uint32_t b = 0; b < armature.bones.size(); ++b) {
        if (!carries[b] && armature.bones[b].parent != kNone) out.push_back(b);
    }
    return out;
}

Armature build_armature(const SkeletonGraph& graph, std::span<const Triangle> triangles,
                        const ArmatureOptions& options) {
    return ArmatureBuilder(graph, triangles, options).build();
}

}  // namespace zskel
