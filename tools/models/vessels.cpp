// Children's radii follow r^n = a^n + b^n (Murray 1926, with a smaller n to get thin vessels
// early).
#include "vessels.h"

#include "tube_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace zskel::models {
namespace {

constexpr double kRootRadius = 0.02, kLeastRadius = 0.002;
constexpr double kExponent = 2.2;
constexpr std::size_t kMostTubes = 255;
constexpr int kTries = 60;
constexpr int kSamples = 10;  // points a tube, where distances are measured

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// The same on every machine, unlike the standard distributions.
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }

  private:
    std::mt19937_64 engine_;
};

glm::dvec3 tilted(const glm::dvec3& axis, double angle, double around) {
    const glm::dvec3 u = glm::normalize(
        glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 v = glm::cross(axis, u);
    return std::cos(angle) * axis + std::sin(angle) * (std::cos(around) * u + std::sin(around) * v);
}

class Growth {
  public:
    explicit Growth(std::uint64_t seed) : random_(seed) {}

    std::vector<Tube> run() {
        Tube root;
        root.start = {0.0, -0.48, 0.0};
        root.end = {0.01, -0.30, 0.0};
        root.start_direction = root.end_direction = glm::dvec3(0, 1, 0);
        root.radius = kRootRadius;
        tubes_.push_back(root);
        for (std::size_t i = 0; i < tubes_.size() && tubes_.size() + 2 <= kMostTubes; ++i) {
            for (int attempt = 0; attempt < kTries && !divide(i, 1.0 - 0.6 * attempt / kTries);
                 ++attempt) {
            }
        }
        return tubes_;
    }

  private:
    Tube make_child(std::size_t parent, double radius, double angle, double around,
                    double shorten) {
        const Tube& from = tubes_[parent];
        Tube tube;
        tube.parent = parent;
        tube.radius = radius;
        tube.start = from.end;
        tube.start_direction = tilted(from.end_direction, angle, around);
        tube.end_direction = tilted(tube.start_direction, random_.between(0.05, 0.35),
                                    random_.between(0.0, 2.0 * std::numbers::pi));
        const double length = shorten * random_.between(0.8, 1.2) * (0.045 + 6.5 * radius);
        tube.end =
            tube.start + length * glm::normalize(tube.start_direction + 0.5 * tube.end_direction);
        return tube;
    }

    /// Lets two tubes leave the end of tube `index`, where there is room for them.
    bool divide(std::size_t index, double shorten) {
        const double radius = tubes_[index].radius;
        const double share = random_.between(0.5, 0.72);
        const double wide = std::max(kLeastRadius, radius * std::pow(share, 1.0 / kExponent));
        const double thin = std::max(kLeastRadius, radius * std::pow(1.0 - share, 1.0 / kExponent));
        const double around = random_.between(0.0, 2.0 * std::numbers::pi);
        const Tube a = make_child(index, wide, random_.between(0.45, 0.65), around, shorten);
        const Tube b =
            make_child(index, thin, random_.between(0.75, 1.0), around + std::numbers::pi, shorten);
        if (radius <= 1.02 * kLeastRadius || !has_room(a) || !has_room(b)) {
            return false;
        }
        tubes_[index].children = {tubes_.size(), tubes_.size() + 1};
        tubes_.push_back(a);
        tubes_.push_back(b);
        return true;
    }

    bool has_room(const Tube& tube) const {
        for (int k = 0; k <= kSamples; ++k) {
            const glm::dvec3 p = glm::abs(tube.at(double(k) / kSamples)) + 1.5 * tube.radius;
            if (std::max({p.x, p.y, p.z}) > 0.5) {
                return false;
            }
        }
        return std::none_of(tubes_.begin(), tubes_.end(), [&](const Tube& other) {
            return &other != &tubes_[tube.parent] &&
                   distance_between(tube, other) < 2.0 * (tube.radius + other.radius) + 0.01;
        });
    }

    static double distance_between(const Tube& a, const Tube& b) {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= kSamples; ++i) {
            for (int j = 0; j <= kSamples; ++j) {
                least = std::min(
                    least, glm::distance(a.at(double(i) / kSamples), b.at(double(j) / kSamples)));
            }
        }
        return least;
    }

    Random random_;
    std::vector<Tube> tubes_;
};

}  // namespace

Model make_vessels(const std::string& name, std::size_t open_ends) {
    return sweep_tubes(name, Growth(2003).run(), open_ends);
}

}  // namespace zskel::models
