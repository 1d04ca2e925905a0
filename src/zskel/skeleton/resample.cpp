#include "zskel/skeleton/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "zskel/core/error.h"
#include "zskel/skeleton/path.h"

namespace zskel {
namespace {

constexpr double kMostNodes = 1e7;

class Resampler {
  public:
    Resampler(CurveGraph& graph, std::span<const Vec3> seed_points, const SurfaceQuery& query,
              const RefineOptions& options, Spacing spacing)
        : graph_(graph),
          seed_points_(seed_points),
          query_(query),
          options_(options),
          spacing_(spacing) {}

    void run() {
        for (const std::vector<std::uint32_t>& branch : graph_.branches()) {
            std::vector<Vec3> line;
            std::vector<std::uint32_t> seeds;
            for (std::size_t i = 0; i < branch.size(); ++i) {
                CurveGraph::Node& node = graph_.nodes[branch[i]];
                line.push_back(node.position);
                if (i == 0 || i + 1 == branch.size()) continue;
                seeds.insert(seeds.end(), node.seeds.begin(), node.seeds.end());
                node.is_removed = true;
            }
            for (std::size_t i = 1; i < branch.size(); ++i) graph_.unlink(branch[i - 1], branch[i]);
            lay_nodes(branch.front(), branch.back(), line, seeds);
        }
    }

  private:
    // Where there is hardly any thickness (open sheets), there is nothing to follow closely.
    double spacing_at(float radius) const {
        const auto r = static_cast<double>(radius);
        if (r < 0.25 * options_.min_spacing_world) return options_.max_spacing_world;
        return std::clamp(r, options_.min_spacing_world, options_.max_spacing_world);
    }

    void lay_nodes(std::uint32_t first, std::uint32_t last, const std::vector<Vec3>& line,
                   const std::vector<std::uint32_t>& seeds) {
        std::vector<std::uint32_t> chain{first};
        for (const Ball& ball : balls_within(line, needed_pieces(first, last)))
            chain.push_back(graph_.add(ball.centre, ball.radius));
        chain.push_back(last);
        for (std::size_t i = 1; i < chain.size(); ++i) graph_.link(chain[i - 1], chain[i]);
        for (const std::uint32_t s : seeds) {
            const Vec3& p = seed_points_[s];
            const std::uint32_t nearest =
                *std::min_element(chain.begin(), chain.end(), [&](auto l, auto r) {
                    return glm::distance(graph_.at(l), p) < glm::distance(graph_.at(r), p);
                });
            graph_.nodes[nearest].seeds.push_back(s);
        }
    }

    // A ring needs three nodes and the second of two branches between the same junctions one of its
    // own.
    int needed_pieces(std::uint32_t first, std::uint32_t last) const {
        const auto& links = graph_.nodes[first].links;
        if (first == last) return 3;
        return std::find(links.begin(), links.end(), last) != links.end() ? 2 : 1;
    }

    // 1 where nodes are not to be even.
    int even_pieces(float length) {
        if (spacing_ != Spacing::Even) return 1;
        const double pieces = std::ceil(static_cast<double>(length) / options_.even_spacing_world);
        nodes_ += pieces;
        if (!(nodes_ <= kMostNodes)) {
            throw UsageError(fmt::format(
                "so small a distance between nodes asks for more than {} of them", kMostNodes));
        }
        return std::max(1, static_cast<int>(pieces));
    }

    struct Ball {
        Vec3 centre;
        float radius;  // inscribed
    };
    Ball ball_at(const Vec3& centre, const Ball& before) const {
        const float within = before.radius + glm::distance(before.centre, centre);
        return {centre, query_.nearest(centre, within).distance};
    }

    // Balls within the line, one local spacing apart. Corners stay where the shortcut past them is
    // not free.
    std::vector<Ball> balls_within(const std::vector<Vec3>& line, int least_pieces) {
        const float length = length_of(line);
        const float longest =
            length / static_cast<float>(std::max(least_pieces, even_pieces(length)));
        std::vector<Ball> balls;
        Ball at = ball_at(line.front(), {line.front(), kInfinity});
        if (!(length > 0.0f)) {
            // What has shrunk to a place keeps the nodes that it needs.
            balls.assign(static_cast<std::size_t>(least_pieces - 1), at);
            return balls;
        }
        std::size_t next = 1;
        while (true) {
            while (next + 1 < line.size() && line[next] == at.centre) ++next;
            const float spacing =
                spacing_ == Spacing::Even
                    ? longest
                    : std::min(longest, static_cast<float>(spacing_at(at.radius)));
            Vec3 here = at.centre;
            float left = spacing;
            std::size_t segment = next;
            while (segment < line.size() && glm::distance(here, line[segment]) <= left) {
                left -= glm::distance(here, line[segment]);
                here = line[segment++];
            }
            const bool is_last = segment >= line.size() ||
                                 (segment + 1 == line.size() &&
                                  glm::distance(here, line.back()) < left + 0.5f * spacing &&
                                  balls.size() + 1 >= static_cast<std::size_t>(least_pieces));
            const Vec3 target = is_last ? line.back()
                                        : here + (line[segment] - here) *
                                                     (left / glm::distance(here, line[segment]));
            if (!query_.sees(at.centre, target) && next < line.size() - (is_last ? 1 : 0) &&
                line[next] != at.centre && segment > next) {
                at = ball_at(line[next++], at);
                balls.push_back(at);
                continue;
            }
            if (is_last) return balls;
            next = segment;
            at = ball_at(target, at);
            balls.push_back(at);
        }
    }

    CurveGraph& graph_;
    std::span<const Vec3> seed_points_;
    const SurfaceQuery& query_;
    const RefineOptions& options_;
    Spacing spacing_;
    double nodes_ = 0.0;  // asked for so far, where they are even
};

}  // namespace

void resample_branches(CurveGraph& graph, std::span<const Vec3> seed_points,
                       const SurfaceQuery& query, const RefineOptions& options, Spacing spacing) {
    Resampler(graph, seed_points, query, options, spacing).run();
}

}  // namespace zskel
