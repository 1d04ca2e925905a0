#include "zskel/visibility/face_lists.h"

namespace zskel {
namespace {

// Nine comparisons tell on which side of every face pyramid's planes a point lies.
constexpr unsigned kX = 1u << 0;  // x > 0
constexpr unsigned kY = 1u << 1;
constexpr unsigned kZ = 1u << 2;
constexpr unsigned kXOverY = 1u << 3;  // x > y
constexpr unsigned kXOverZ = 1u << 4;
constexpr unsigned kYOverZ = 1u << 5;
constexpr unsigned kXPlusY = 1u << 6;  // x + y > 0
constexpr unsigned kXPlusZ = 1u << 7;
constexpr unsigned kYPlusZ = 1u << 8;

// A pyramid lies on the set side of some planes and on the clear side of others.
struct Pyramid {
    unsigned set;
    unsigned clear;
};
constexpr std::array<Pyramid, 6> kPyramids{{
    {kX | kXOverY | kXPlusY | kXOverZ | kXPlusZ, 0},
    {0, kX | kXOverY | kXPlusY | kXOverZ | kXPlusZ},
    {kY | kXPlusY | kYOverZ | kYPlusZ, kXOverY},
    {kXOverY, kY | kXPlusY | kYOverZ | kYPlusZ},
    {kZ | kXPlusZ | kYPlusZ, kXOverZ | kYOverZ},
    {kXOverZ | kYOverZ, kZ | kXPlusZ | kYPlusZ},
}};

unsigned code_of(const Vec3& p) {
    return (p.x > 0.0f ? kX : 0u) | (p.y > 0.0f ? kY : 0u) | (p.z > 0.0f ? kZ : 0u) |
           (p.x > p.y ? kXOverY : 0u) | (p.x > p.z ? kXOverZ : 0u) | (p.y > p.z ? kYOverZ : 0u) |
           (p.x + p.y > 0.0f ? kXPlusY : 0u) | (p.x + p.z > 0.0f ? kXPlusZ : 0u) |
           (p.y + p.z > 0.0f ? kYPlusZ : 0u);
}

}  // namespace

void list_faces(const Surface& surface, const Vec3& eye, FaceLists& lists) {
    lists.vertex_codes.resize(surface.positions.size());
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        lists.vertex_codes[v] = static_cast<std::uint16_t>(code_of(surface.positions[v] - eye));
    }
    for (auto& list : lists.triangles) list.clear();
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const Triangle& tri = surface.triangles[t];
        const unsigned a = lists.vertex_codes[tri.x];
        const unsigned b = lists.vertex_codes[tri.y];
        const unsigned c = lists.vertex_codes[tri.z];
        const unsigned some = a | b | c;  // bits set at some corner
        const unsigned all = a & b & c;   // bits set at every corner
        for (std::size_t f = 0; f < kPyramids.size(); ++f) {
            const Pyramid& pyramid = kPyramids[f];
            const bool outside = (pyramid.set & ~some) != 0 || (pyramid.clear & all) != 0;
            if (!outside) lists.triangles[f].push_back(t);
        }
    }
}

}  // namespace zskel
