#include "zskel/mesh/winding_tree.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "zskel/mesh/bounds.h"
#include "zskel/mesh/winding.h"

namespace zskel {
namespace {

constexpr std::uint32_t kLeaf = 8;  // triangles
constexpr double kFar = 2.5;        // radii from which a group counts as one

}  // namespace

WindingTree::WindingTree(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
    for (const Triangle& t : triangles)
        centers_.push_back((DVec3(positions[t.x]) + DVec3(positions[t.y]) + DVec3(positions[t.z])) /
                           3.0);
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
    for (const std::uint32_t t : order_) ordered_.push_back(triangles[t]);
    centers_ = {};
}

std::uint32_t WindingTree::build(std::uint32_t first, std::uint32_t count) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Node node;
    node.first = first;
    node.count = count;
    Box box;
    double weight = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Triangle& t = triangles_[order_[i]];
        const DVec3 a(positions_[t.x]);
        const DVec3 area = 0.5 * glm::cross(DVec3(positions_[t.y]) - a, DVec3(positions_[t.z]) - a);
        node.area += area;
        node.center += glm::length(area) * centers_[order_[i]];
        weight += glm::length(area);
        box.add(centers_[order_[i]]);
    }
    node.center = weight > 0.0 ? node.center / weight : centers_[order_[first]];
    for (std::uint32_t i = first; i < first + count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const DVec3 corner(positions_[triangles_[order_[i]][k]]);
            node.radius = std::max(node.radius, glm::distance(corner, node.center));
        }
    }
    if (count > kLeaf) {
        const DVec3 size = box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        const auto begin = order_.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(centers_[a][axis], a) < std::pair(centers_[b][axis], b);
        });
        build(first, half);
        node.right = build(first + half, count - half);
    }
    nodes_[number] = node;
    return number;
}

double WindingTree::at(const DVec3& point) const {
    double sum = 0.0;
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::uint32_t number = open.back();
        const Node& node = nodes_[number];
        open.pop_back();
        const DVec3 way = node.center - point;
        const double distance = glm::length(way);
        if (distance > kFar * node.radius) {
            sum += glm::dot(node.area, way) /
                   (4.0 * std::numbers::pi * distance * distance * distance);
        } else if (node.right == 0) {
            sum += winding_number(positions_, std::span(ordered_).subspan(node.first, node.count),
                                  point);
        } else {
            open.push_back(node.right);
            open.push_back(number + 1);
        }
    }
    return sum;
}

}  // namespace zskel
