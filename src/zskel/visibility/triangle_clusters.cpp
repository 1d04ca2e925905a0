#include "zskel/visibility/triangle_clusters.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace zskel {
namespace {

void add_cluster(TriangleClusters& out, const Surface& surface,
                 std::span<const std::uint32_t> members) {
    const std::size_t cluster = out.first_block.size() - 1;
    if (cluster % kBlock == 0) {
        BoxBlock& empty = out.boxes.emplace_back();
        for (auto& axis : empty.low) axis.fill(kInfinity);
        for (auto& axis : empty.high) axis.fill(-kInfinity);
    }
    BoxBlock& boxes = out.boxes.back();
    for (std::size_t first = 0; first < members.size(); first += kBlock) {
        TriangleBlock& block = out.triangles.emplace_back();
        for (std::size_t i = 0; i < kBlock; ++i) {
            const bool padding = first + i >= members.size();
            const std::uint32_t t = members[padding ? first : first + i];
            const Vec3 normal = padding ? Vec3(0.0f) : surface.triangle_normals[t];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto axis = static_cast<int>(k);
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    const std::uint32_t v = surface.triangles[t][static_cast<int>(corner)];
                    const float x = surface.positions[v][axis];
                    block.corner[3 * corner + k][i] = x;
                    float& low = boxes.low[k][cluster % kBlock];
                    float& high = boxes.high[k][cluster % kBlock];
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
                block.normal[k][i] = normal[axis];
            }
            block.id[i] = t;
        }
    }
    out.first_block.push_back(static_cast<std::uint32_t>(out.triangles.size()));
}

// Halves the members across the longest side of their centres' box, by whole blocks.
void split(TriangleClusters& out, const Surface& surface, const std::vector<Vec3>& centers,
           std::span<std::uint32_t> members, std::size_t most) {
    if (members.size() <= most) return add_cluster(out, surface, members);
    Vec3 low(kInfinity);
    Vec3 high(-kInfinity);
    for (const std::uint32_t t : members) {
        low = glm::min(low, centers[t]);
        high = glm::max(high, centers[t]);
    }
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = (members.size() / 2 + kBlock - 1) / kBlock * kBlock;
    std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half),
                     members.end(), [&](std::uint32_t a, std::uint32_t b) {
                         return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
                     });
    split(out, surface, centers, members.first(half), most);
    split(out, surface, centers, members.subspan(half), most);
}

}  // namespace

TriangleClusters cluster_triangles(const Surface& surface, std::size_t most) {
    TriangleClusters out;
    out.first_block.push_back(0);
    std::vector<Vec3> centers(surface.triangles.size());
    for (std::size_t t = 0; t < centers.size(); ++t) {
        const Triangle& tri = surface.triangles[t];
        centers[t] =
            (surface.positions[tri.x] + surface.positions[tri.y] + surface.positions[tri.z]) / 3.0f;
    }
    std::vector<std::uint32_t> members(surface.triangles.size());
    std::iota(members.begin(), members.end(), 0u);
    split(out, surface, centers, members, most);
    return out;
}

}  // namespace zskel
