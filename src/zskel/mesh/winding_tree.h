#pragma once

#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Generalised winding numbers of many points about one set of triangles: far groups of triangles
/// count as one that has their area vectors' sum, off by some thousandths; O(log n) a point. See
/// Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding numbers for soups and clouds"
/// (2018); theirs has terms of higher order.
class WindingTree {
  public:
    /// Neither is copied; both must outlive it.
    WindingTree(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles);
    double at(const DVec3& point) const;

  private:
    struct Node {
        DVec3 center{0.0};        // of the area
        DVec3 area{0.0};          // vector
        double radius = 0.0;      // of a ball round it all
        std::uint32_t first = 0;  // in `order_`
        std::uint32_t count = 0;
        std::uint32_t right = 0;  // the left child is the next node; 0: a leaf
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t count);

    const std::vector<Vec3>& positions_;
    const std::vector<Triangle>& triangles_;
    std::vector<DVec3> centers_;
    std::vector<std::uint32_t> order_;
    std::vector<Triangle> ordered_;
    std::vector<Node> nodes_;
};

}  // namespace zskel
