#include "zskel/mesh/self_intersections.h"

#include <atomic>
#include <cmath>
#include <exception>
#include <limits>

#include "zskel/core/embree.h"
#include "zskel/core/loop_order.h"

namespace zskel {
namespace {

struct Triangles {
    const std::vector<DVec3>& positions;
    const std::vector<Triangle>& triangles;
    std::vector<std::atomic<bool>> crosses;
    std::size_t most_pairs;
    std::atomic<std::size_t> pairs = 0;
    LoopOrder order{};  // of Embree's threads, which call what follows
};

double side_of(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& p) {
    return glm::dot(glm::cross(b - a, c - a), p - a);
}

bool passes(const DVec3& from, const DVec3& to, const DVec3& a, const DVec3& b, const DVec3& c) {
    const double before = side_of(a, b, c, from);
    const double behind = side_of(a, b, c, to);
    if (!(before * behind < 0.0)) return false;
    const double ab = side_of(from, to, a, b);
    const double bc = side_of(from, to, b, c);
    const double ca = side_of(from, to, c, a);
    return (ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
}

bool has(const Triangle& t, std::uint32_t vertex) {
    return t.x == vertex || t.y == vertex || t.z == vertex;
}

// An edge that has a corner in common with the other triangle only touches it there; where two
// triangles with a common corner cross, the edge opposite to it does in one of them.
bool edge_passes(const Triangles& all, const Triangle& one, const Triangle& other) {
    const auto& p = all.positions;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = one[k];
        const std::uint32_t to = one[(k + 1) % 3];
        if (has(other, from) || has(other, to)) continue;
        if (passes(p[from], p[to], p[other.x], p[other.y], p[other.z])) return true;
    }
    return false;
}

// Passes through Embree, which ends the search and frees it, as a rule by the caller's thread: that
// comes after the bodies.
class TooManyPairs : public std::exception {
  public:
    explicit TooManyPairs(LoopOrder& order) : order_(order) {}
    ~TooManyPairs() override { order_.join(); }

  private:
    LoopOrder& order_;
};

// Of two triangles whose boxes meet; called by several threads at once.
void visit_pairs(void* user, RTCCollision* pairs, unsigned count) {
    auto& all = *static_cast<Triangles*>(user);
    const LoopOrder::Body ordered(all.order);
    const std::size_t pairs_so_far = all.pairs += count;
    if (pairs_so_far > all.most_pairs) throw TooManyPairs(all.order);
    for (unsigned i = 0; i < count; ++i) {
        const std::uint32_t a = pairs[i].primID0;
        const std::uint32_t b = pairs[i].primID1;
        if (a == b || (all.crosses[a] && all.crosses[b])) continue;
        const Triangle& one = all.triangles[a];
        const Triangle& other = all.triangles[b];
        if (!edge_passes(all, one, other) && !edge_passes(all, other, one)) continue;
        all.crosses[a] = true;
        all.crosses[b] = true;
    }
}

// The box in floats, rounded outwards.
void bound(const RTCBoundsFunctionArguments* arguments) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    auto& all = *static_cast<Triangles*>(arguments->geometryUserPtr);
    const LoopOrder::Body ordered(all.order);
    const Triangle& t = all.triangles[arguments->primID];
    const DVec3& a = all.positions[t.x];
    const DVec3& b = all.positions[t.y];
    const DVec3& c = all.positions[t.z];
    const DVec3 low = glm::min(glm::min(a, b), c);
    const DVec3 high = glm::max(glm::max(a, b), c);
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kInfinity); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kInfinity); };
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = down(low.x);
    box.lower_y = down(low.y);
    box.lower_z = down(low.z);
    box.upper_x = up(high.x);
    box.upper_y = up(high.y);
    box.upper_z = up(high.z);
}

}  // namespace

std::optional<std::vector<std::uint32_t>> crossing_triangles(const std::vector<DVec3>& positions,
                                                             const std::vector<Triangle>& triangles,
                                                             std::size_t most_pairs) {
    Triangles all{positions, triangles, std::vector<std::atomic<bool>>(triangles.size()),
                  most_pairs};
    const EmbreeDevice device = open_embree();
    const EmbreeHierarchy scene(rtcNewScene(device.get()));
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.size()));
    rtcSetGeometryUserData(geometry, &all);
    rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    build_hierarchy(scene.get(), device.get());
    rtcCollide(scene.get(), scene.get(), visit_pairs, &all);
    if (all.pairs > most_pairs) return std::nullopt;
    std::vector<std::uint32_t> crossing;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (all.crosses[t]) crossing.push_back(t);
    }
    return crossing;
}

}  // namespace zskel
