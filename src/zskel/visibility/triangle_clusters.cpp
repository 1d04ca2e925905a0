#include "zskel/visibility/triangle_clusters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>

#include "zskel/core/parallel.h"

namespace zskel {
namespace {

constexpr std::size_t kGroup = kBlock * kBlock;  // triangles

// A triangle and its centre: together, since halving looks at both.
struct Member {
    Vec3 center;
    std::uint32_t triangle;
};
using Members = std::span<Member>;

// Sorts many members into what lies before, in and after one of `kBins` slices along an axis, the
// one that the `half`-th is in, and returns that: all that a selection has to look at.
Members narrowed(Members members, std::size_t half, int axis, float low, float size) {
    constexpr std::size_t kBins = 256;
    constexpr std::size_t kMany = 4096;  // fewer: a selection from all of them is as quick
    if (members.size() < kMany || half >= members.size() || !(size > 0.0f)) return members;
    const float scale = static_cast<float>(kBins) / size;
    const auto bin_of = [&](const Member& member) {
        return std::min(static_cast<std::size_t>((member.center[axis] - low) * scale), kBins - 1);
    };
    std::array<std::size_t, kBins> count{};
    for (const Member& member : members) ++count[bin_of(member)];
    std::size_t bin = 0;
    for (std::size_t sum = count[0]; sum <= half; sum += count[++bin]) {
    }
    const auto in = std::partition(members.begin(), members.end(),
                                   [&](const Member& member) { return bin_of(member) < bin; });
    const auto after = std::partition(in, members.end(),
                                      [&](const Member& member) { return bin_of(member) == bin; });
    return {in, after};
}

// Halves along the longest side of the centres' box, by whole groups or else by whole blocks.
std::pair<Members, Members> halves(Members members) {
    Vec3 low(kInfinity);
    Vec3 high(-kInfinity);
    for (const Member& member : members) {
        low = glm::min(low, member.center);
        high = glm::max(high, member.center);
    }
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t unit = members.size() > kGroup ? kGroup : kBlock;
    const std::size_t half = (members.size() / 2 + unit - 1) / unit * unit;
    const Members around = narrowed(members, half, axis, low[axis], size[axis]);
    const auto before = around.data() - members.data();
    std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(half) - before,
                     around.end(), [axis](const Member& a, const Member& b) {
                         return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                                 : a.triangle < b.triangle;
                     });
    return {members.first(half), members.subspan(half)};
}

// Parts of at most `most` members, neighbours in space next to each other in the list.
std::vector<Members> parts_of(std::vector<Members> parts, std::size_t most) {
    const auto is_large = [&](const Members& part) { return part.size() > most; };
    while (std::any_of(parts.begin(), parts.end(), is_large)) {
        std::vector<std::pair<Members, Members>> split(parts.size());
        parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                split[i] = is_large(parts[i]) ? halves(parts[i]) : std::pair(parts[i], Members());
            }
        });
        parts.clear();
        for (const auto& [first, second] : split) {
            parts.push_back(first);
            if (!second.empty()) parts.push_back(second);
        }
    }
    return parts;
}

BoxBlock empty_boxes() {
    BoxBlock boxes;
    for (auto& axis : boxes.low) axis.fill(kInfinity);
    for (auto& axis : boxes.high) axis.fill(-kInfinity);
    return boxes;
}

// Fills a block; what is left over repeats the first triangle, without a normal.
void fill(TriangleBlock& block, BoxBlock& boxes, std::size_t box, const Surface& surface,
          const Members& members) {
    for (std::size_t i = 0; i < kBlock; ++i) {
        const bool padding = i >= members.size();
        const std::uint32_t t = members[padding ? 0 : i].triangle;
        const Vec3 normal = padding ? Vec3(0.0f) : surface.triangle_normals[t];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<int>(k);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t v = surface.triangles[t][static_cast<int>(corner)];
                const float x = surface.positions[v][axis];
                block.corner[3 * corner + k][i] = x;
                boxes.low[k][box] = std::min(boxes.low[k][box], x);
                boxes.high[k][box] = std::max(boxes.high[k][box], x);
            }
            block.normal[k][i] = normal[axis];
        }
        block.id[i] = t;
    }
}

// A bit for each box that is nearer.
std::uint32_t near_boxes(const BoxBlock& boxes, const Vec3& point, float distance) {
    std::array<float, kBlock> squared{};
    for (std::size_t k = 0; k < 3; ++k) {
        const float x = point[static_cast<int>(k)];
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float off = std::max({boxes.low[k][i] - x, x - boxes.high[k][i], 0.0f});
            squared[i] += off * off;
        }
    }
    std::uint32_t near = 0;
    for (std::size_t i = 0; i < kBlock; ++i)
        near |= squared[i] < distance * distance ? 1u << i : 0u;
    return near;
}

}  // namespace

bool is_near(const TriangleClusters& clusters, const Vec3& point, float distance) {
    for (std::size_t b = 0; b < clusters.group_boxes.size(); ++b) {
        std::uint32_t near = near_boxes(clusters.group_boxes[b], point, distance);
        for (; near != 0; near &= near - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(near));
            if (near_boxes(clusters.block_boxes[b * kBlock + i], point, distance) != 0) return true;
        }
    }
    return false;
}

TriangleClusters cluster_triangles(const Surface& surface) {
    std::vector<Member> members(surface.triangles.size());
    for (std::uint32_t t = 0; t < members.size(); ++t) {
        const Triangle& tri = surface.triangles[t];
        members[t] = {
            (surface.positions[tri.x] + surface.positions[tri.y] + surface.positions[tri.z]) / 3.0f,
            t};
    }
    const std::vector<Members> groups = parts_of({Members(members)}, kGroup);
    TriangleClusters out;
    out.first_block.push_back(0);
    for (const Members& group : groups) {
        const std::size_t blocks = (group.size() + kBlock - 1) / kBlock;
        out.first_block.push_back(out.first_block.back() + static_cast<std::uint32_t>(blocks));
    }
    out.triangles.resize(out.first_block.back());
    out.block_boxes.assign(groups.size(), empty_boxes());
    out.group_boxes.assign((groups.size() + kBlock - 1) / kBlock, empty_boxes());
    parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t g = begin; g < end; ++g) {
            std::size_t box = 0;
            for (const Members& block : parts_of({groups[g]}, kBlock)) {
                fill(out.triangles[out.first_block[g] + box], out.block_boxes[g], box, surface,
                     block);
                ++box;
            }
        }
    });
    for (std::size_t g = 0; g < groups.size(); ++g) {
        BoxBlock& boxes = out.group_boxes[g / kBlock];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& low = out.block_boxes[g].low[k];
            const auto& high = out.block_boxes[g].high[k];
            boxes.low[k][g % kBlock] = *std::min_element(low.begin(), low.end());
            boxes.high[k][g % kBlock] = *std::max_element(high.begin(), high.end());
        }
    }
    return out;
}

}  // namespace zskel
