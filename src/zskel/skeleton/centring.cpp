#include "zskel/skeleton/centring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/skeleton/climb.h"
#include "zskel/skeleton/section.h"

namespace zskel {
namespace {

class Centring {
  public:
    Centring(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options)
        : graph_(graph),
          query_(query),
          options_(options),
          balls_(graph.nodes.size()),
          sections_(graph.nodes.size()) {}

    void run() {
        for (int i = 0; i < options_.smoothing_sweeps; ++i) smooth(options_.smoothing);
        weigh_centring();
        climb();
        for (int i = 0; i < options_.sweeps; ++i) {
            centre();
            smooth(options_.smoothing);
            smooth(-options_.unshrink);
        }
    }

  private:
    using Node = CurveGraph::Node;
    struct Ball {
        Vec3 centre{0.0f};
        float radius = 0.0f;
    };
    struct Section {
        Vec3 seen_from{2.0f * SurfaceQuery::kFarthest};  // from nowhere yet
        Vec3 tangent{0.0f};
        Vec3 centre{0.0f};
    };
    // In radii, and as a cosine: what may change before a section is looked at again.
    static constexpr float kSameAcross = 0.05f;
    static constexpr float kSameAlong = 0.2f;
    static constexpr float kSameTangent = 0.9995f;

    // One pass over all nodes but the ends: each towards the middle of its neighbours, or away from
    // it where `share` is negative. A move that would leave the solid is not made.
    void smooth(double share) {
        std::vector<std::pair<std::uint32_t, Vec3>> targets;
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            const Node& node = graph_.nodes[n];
            if (node.is_removed || node.links.size() < 2) continue;
            DVec3 middle(0.0);
            for (const std::uint32_t other : node.links) middle += DVec3(graph_.at(other));
            middle /= static_cast<double>(node.links.size());
            // A junction is held by its branches; the smoothing alone would drag it to the longest.
            const double held = node.links.size() > 2 ? 0.3 : 1.0;
            const DVec3 here(node.position);
            targets.emplace_back(n, Vec3(here + (middle - here) * (share * held)));
        }
        move(targets);
    }

    // How much each node within a branch is centred: little next to junctions.
    void weigh_centring() {
        centring_.assign(graph_.nodes.size(), 0.0f);
        for (const std::vector<std::uint32_t>& branch : graph_.branches()) {
            for (const std::uint32_t n : branch) {
                if (graph_.nodes[n].links.size() == 2)
                    centring_[n] = static_cast<float>(options_.centring);
            }
            fade_centring(branch.begin(), branch.end());
            fade_centring(branch.rbegin(), branch.rend());
        }
    }

    template <typename Iterator>
    void fade_centring(Iterator first, const Iterator& last) {
        const Node& junction = graph_.nodes[*first];
        if (junction.links.size() < 3) return;
        const float reach = static_cast<float>(options_.junction_radii) *
                            query_.nearest(junction.position).distance;
        for (; first != last; ++first) {
            const float away = glm::distance(graph_.at(*first), junction.position);
            if (away >= reach) return;
            centring_[*first] *= (away / reach) * (away / reach);
        }
    }

    void climb() {
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            const Node& node = graph_.nodes[n];
            if (!node.is_removed && node.links.size() > 2) climbs_.push_back({n, {}});
        }
        parallel_for(climbs_.size(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                climbs_[i].second = climb_to_thickest(graph_.at(climbs_[i].first),
                                                      options_.junction_reach_radii, query_);
        });
    }

    // One pass over all nodes within branches, each towards the centre of its section, and over all
    // junctions, each towards the thickest place near it.
    void centre() {
        std::vector<std::pair<std::uint32_t, Vec3>> targets;
        for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (centring_[n] > 0.0f) targets.emplace_back(n, Vec3(0.0f));
        }
        parallel_for(targets.size(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) targets[i].second = centred(targets[i].first);
        });
        const auto pull = static_cast<float>(options_.junction_pull);
        for (const auto& [n, climb] : climbs_)
            targets.emplace_back(n, glm::mix(graph_.at(n), climb.top, pull * climb.steepness));
        move(targets);
    }

    Vec3 centred(std::uint32_t n) {
        const Node& node = graph_.nodes[n];
        const Vec3 chord = ahead_of(n, node.links[1]) - ahead_of(n, node.links[0]);
        if (!(glm::length(chord) > 0.0f)) return node.position;
        const Vec3 step = step_to_centre(n, glm::normalize(chord)) * centring_[n];
        const float length = glm::length(step);
        const auto share = static_cast<float>(options_.longest_move_radii);
        if (length <= share * clearance(n, node.position)) return node.position + step;
        const float longest = share * look_round(n);
        return node.position + (length > longest ? step * (longest / length) : step);
    }

    Vec3 step_to_centre(std::uint32_t n, const Vec3& tangent) {
        Section& section = sections_[n];
        const Vec3& here = graph_.at(n);
        if (!is_known(section, here, tangent, balls_[n].radius)) {
            section = {here, tangent, here + step_to_section_centre(query_, here, tangent)};
            if (clearance(n, here) <= 0.0f) look_round(n);
        }
        const Vec3 step = section.centre - here;
        return step - tangent * glm::dot(tangent, step);
    }

    // A section that was looked at from near here has the same centre: nearer across than along.
    static bool is_known(const Section& section, const Vec3& here, const Vec3& tangent,
                         float radius) {
        const Vec3 moved = here - section.seen_from;
        const float along = std::abs(glm::dot(moved, tangent));
        const float across = glm::length(moved - tangent * glm::dot(moved, tangent));
        return across <= kSameAcross * radius && along <= kSameAlong * radius &&
               glm::dot(section.tangent, tangent) >= kSameTangent;
    }

    // A lower bound of the inscribed radius at `point`, from where node `n` last looked round.
    float clearance(std::uint32_t n, const Vec3& point) const {
        return balls_[n].radius - glm::distance(balls_[n].centre, point);
    }
    float look_round(std::uint32_t n) {
        const Vec3& here = graph_.at(n);
        const Ball& last = balls_[n];
        const float within =
            last.radius > 0.0f ? last.radius + glm::distance(last.centre, here) : kInfinity;
        balls_[n] = {here, query_.nearest(here, within).distance};
        return balls_[n].radius;
    }

    // Whether nothing lies between node `n`, moved to `to`, and its neighbour: where their balls
    // meet, no ray is needed.
    bool is_free(std::uint32_t n, const Vec3& to, std::uint32_t other) {
        const float length = glm::distance(graph_.at(other), to);
        const auto balls_meet = [&] {
            return length < clearance(n, to) + clearance(other, graph_.at(other));
        };
        if (balls_meet()) return true;
        for (const std::uint32_t k : {n, other}) {
            if (clearance(k, graph_.at(k)) <= 0.5f * balls_[k].radius) look_round(k);
        }
        return balls_meet() || query_.sees(graph_.at(other), to);
    }

    // A point of the branch two nodes on from `n` over its neighbour `next`.
    const Vec3& ahead_of(std::uint32_t n, std::uint32_t next) const {
        const auto& links = graph_.nodes[next].links;
        if (links.size() != 2) return graph_.at(next);
        return graph_.nodes[links[0] == n ? links[1] : links[0]].position;
    }

    void move(const std::vector<std::pair<std::uint32_t, Vec3>>& targets) {
        for (const auto& target : targets) {
            const std::uint32_t n = target.first;
            const Vec3& to = target.second;
            Node& node = graph_.nodes[n];
            const bool stays =
                std::all_of(node.links.begin(), node.links.end(),
                            [&](std::uint32_t other) { return is_free(n, to, other); });
            if (stays) node.position = to;
        }
    }

    CurveGraph& graph_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
    std::vector<Ball> balls_;  // inscribed, where each node last looked
    std::vector<Section> sections_;
    std::vector<float> centring_;  // of every node: share of the way that a sweep takes
    std::vector<std::pair<std::uint32_t, Climb>> climbs_;  // of every junction
};

}  // namespace

void centre_branches(CurveGraph& graph, const SurfaceQuery& query, const RefineOptions& options) {
    Centring(graph, query, options).run();
}

}  // namespace zskel
