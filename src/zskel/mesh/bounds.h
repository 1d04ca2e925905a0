#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// A box along the axes.
struct Box {
    DVec3 low{std::numeric_limits<double>::infinity()};
    DVec3 high{-std::numeric_limits<double>::infinity()};

    void add(const DVec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool holds(const DVec3& p) const {
        return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
    }
    DVec3 size() const { return high - low; }
    double longest() const { return std::max({size().x, size().y, size().z}); }
    double diagonal() const { return glm::length(size()); }
};

/// The box round points. @param points  not empty.
template <typename Point>
Box box_of(const std::vector<Point>& points) {
    Box box;
    for (const Point& p : points) box.add(DVec3(p));
    return box;
}

}  // namespace zskel
