#include "scoring/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scoring/numbers.h"
#include "zskel/core/across.h"
#include "zskel/core/parallel.h"

namespace zskel::scoring {
namespace {

constexpr double kTurnStep = 0.01;
constexpr double kCentreStep = 0.005;
constexpr std::size_t kTangentSteps = 2;  // to each side
constexpr std::size_t kRays = 48;
constexpr double kLongestRay = 3.0;  // in medians

// A point of a branch and where the branch goes there.
struct Station {
    CurveSample sample;
    DVec3 direction;
};

std::vector<Station> stations_along(const SkeletonGraph& graph, const Branch& branch) {
    const std::vector<CurveSample> points = resample_branch(graph, branch, kCentreStep);
    std::vector<Station> out;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const std::size_t before = i - std::min(i, kTangentSteps);
        const std::size_t after = std::min(points.size() - 1, i + kTangentSteps);
        const DVec3 along = points[after].position - points[before].position;
        if (glm::length(along) > 0.0) out.push_back({points[i], glm::normalize(along)});
    }
    return out;
}

double off_centre_at(const Subject& subject, const Station& station) {
    const Across frame(station.direction);
    std::array<double, kRays> rays{};
    for (std::size_t i = 0; i < kRays; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kRays;
        rays[i] = subject.ray(station.sample.position, frame.at(angle)).value_or(1.0);
    }
    const double longest = kLongestRay * *median({rays.begin(), rays.end()});
    double sum = 0.0;
    for (std::size_t i = 0; i < kRays / 2; ++i) {
        const double a = std::min(rays[i], longest);
        const double b = std::min(rays[i + kRays / 2], longest);
        sum += a + b > 0.0 ? std::abs(a - b) / (a + b) : 0.0;
    }
    return sum / (kRays / 2.0);
}

}  // namespace

std::size_t count_spurs(const Subject& subject, const SkeletonGraph& graph,
                        const std::vector<Branch>& branches) {
    std::size_t count = 0;
    for (const Branch& branch : branches) {
        const bool starts_free = branch.start_degree == 1;
        if (starts_free == (branch.stop_degree == 1)) continue;
        const std::uint32_t inner = starts_free ? branch.nodes.back() : branch.nodes.front();
        if (branch.length < subject.distance_at(graph.nodes[inner].position)) ++count;
    }
    return count;
}

std::optional<double> mean_turn_deg(const SkeletonGraph& graph,
                                    const std::vector<Branch>& branches) {
    std::vector<double> turns;
    for (const Branch& branch : branches) {
        const std::vector<CurveSample> points = resample_branch(graph, branch, kTurnStep);
        for (std::size_t i = 2; i < points.size(); ++i) {
            const DVec3 one = points[i - 1].position - points[i - 2].position;
            const DVec3 next = points[i].position - points[i - 1].position;
            turns.push_back(
                glm::degrees(std::atan2(glm::length(glm::cross(one, next)), glm::dot(one, next))));
        }
    }
    return mean(turns);
}

std::vector<double> off_centre(const Subject& subject, const SkeletonGraph& graph,
                               const std::vector<Branch>& branches, const CurveSides& sides) {
    std::vector<Station> stations;
    for (const Branch& branch : branches) {
        const std::vector<Station> some = stations_along(graph, branch);
        stations.insert(stations.end(), some.begin(), some.end());
    }
    std::vector<double> out(stations.size());
    parallel_for(stations.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            out[i] =
                sides.is_inside(stations[i].sample) ? off_centre_at(subject, stations[i]) : 1.0;
        }
    });
    return out;
}

}  // namespace zskel::scoring
