// `summarize` by registers, compiled once for every instruction set. Sums are taken in each face's
// own axes (right, up, forward) and turned into the world's at its end.
#include "zskel/core/simd_targets.h"
#include "zskel/visibility/zbuffer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "zskel/visibility/zbuffer_summarize.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace zskel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBlock>;
using IntTag = hn::RebindToSigned<Tag>;
using F = hn::Vec<Tag>;

float sum(F v) {
    return hn::GetLane(hn::SumOfLanes(Tag(), v));
}

// Least distance, measured along `force`, to anything within the cone about it.
float clearance_ahead(const TexelGrid& grid, const ZBuffer& buffer, const Vec3& force) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    const auto n = static_cast<std::size_t>(grid.face_px);
    const Vec3 ahead = glm::normalize(force);
    // 1 / (r cos) is greatest where r cos is least.
    F greatest = hn::Zero(d);
    for (std::size_t f = 0; f < 6; ++f) {
        const FaceAxes& face = grid.faces[f];
        const auto along = [&](int k) { return face.sign[k] * ahead[face.axis[k]]; };
        // A face whose every direction leads off cannot hold the cone.
        if (along(2) + std::abs(along(0)) + std::abs(along(1)) <= 0.0f) continue;
        const F a = hn::Set(d, along(0));
        for (std::size_t row = 0; row < n; ++row) {
            const F rest = hn::Set(d, along(2) + along(1) * grid.center[row]);
            for (std::size_t column = 0; column < n; column += lanes) {
                const std::size_t at = row * grid.stride + column;
                const F forward = hn::MulAdd(a, hn::Load(d, &grid.center[column]), rest);
                const F cosine = hn::Mul(forward, hn::Load(d, &grid.inverse_len[at]));
                const F depth = hn::Load(d, &buffer.inverse_depth[f * n * grid.stride + at]);
                const auto in_cone = hn::Ge(cosine, hn::Set(d, kAheadCosine));
                greatest = hn::Max(greatest, hn::IfThenElseZero(in_cone, hn::Div(depth, forward)));
            }
        }
    }
    const float inverse = hn::GetLane(hn::MaxOfLanes(d, greatest));
    return inverse > 0.0f ? 1.0f / inverse : kInfinity;
}

EyeRecord summarize(const Surface& surface, const TexelGrid& grid, const ZBuffer& buffer) {
    const Tag d;
    const IntTag di;
    const std::size_t lanes = hn::Lanes(d);
    const auto n = static_cast<std::size_t>(grid.face_px);
    const F zero = hn::Zero(d);
    const auto* normals = reinterpret_cast<const float*>(surface.triangle_normals.data());
    Vec3 force(0.0f);
    glm::mat3 jacobian(0.0f);
    F hits = zero;
    F backs = zero;
    F nearest = zero;
    for (std::size_t f = 0; f < 6; ++f) {
        const FaceAxes& face = grid.faces[f];
        const float* depths = &buffer.inverse_depth[f * n * grid.stride];
        const auto* ids = reinterpret_cast<const std::int32_t*>(&buffer.id[f * n * grid.stride]);
        F push[3] = {zero, zero, zero};
        F aa = zero;
        F bb = zero;
        F ww = zero;
        F ab = zero;
        F aw = zero;
        F bw = zero;
        for (std::size_t row = 0; row < n; ++row) {
            const F v = hn::Set(d, grid.center[row]);
            for (std::size_t column = 0; column < n; column += lanes) {
                const std::size_t at = row * grid.stride + column;
                const F u = hn::Load(d, &grid.center[column]);
                const F depth = hn::Load(d, depths + at);
                const F scale = hn::Load(d, &grid.inverse_len[at]);
                const F weight = hn::Load(d, &grid.weight[at]);
                const F inverse = hn::Mul(depth, scale);  // 1 / r
                const auto hit = hn::Gt(depth, zero);
                nearest = hn::Max(nearest, inverse);
                const F share = hn::Mul(hn::Mul(weight, inverse), scale);
                push[0] = hn::MulAdd(share, u, push[0]);
                push[1] = hn::MulAdd(share, v, push[1]);
                push[2] = hn::Add(share, push[2]);

                const auto id = hn::Load(di, ids + at);
                // Nothing seen, and a row's padding, are -1; any normal does, since they weigh 0.
                const auto base = hn::Max(hn::Add(hn::Add(id, id), id), hn::Zero(di));
                const auto normal = [&](int k) {
                    return hn::Mul(hn::Set(d, face.sign[k]),
                                   hn::GatherIndex(d, normals + face.axis[k], base));
                };
                const F na = normal(0);
                const F nb = normal(1);
                const F nw = normal(2);
                const F facing = hn::Mul(scale, hn::MulAdd(na, u, hn::MulAdd(nb, v, nw)));
                hits = hn::Add(hits, hn::IfThenElseZero(hit, weight));
                backs =
                    hn::Add(backs, hn::IfThenElseZero(hn::And(hit, hn::Gt(facing, zero)), weight));
                // D g^T, with g = n / (r (n.D)) and its grazing values floored.
                const F floor = hn::Max(hn::Abs(facing), hn::Set(d, kGrazingCosine));
                const F over = hn::CopySign(hn::Div(hn::Mul(share, inverse), floor), facing);
                const F ga = hn::Mul(over, na);
                const F gb = hn::Mul(over, nb);
                const F gw = hn::Mul(over, nw);
                aa = hn::MulAdd(u, ga, aa);
                bb = hn::MulAdd(v, gb, bb);
                ww = hn::Add(gw, ww);
                ab = hn::Add(ab, hn::MulAdd(u, gb, hn::Mul(v, ga)));
                aw = hn::Add(aw, hn::MulAdd(u, gw, ga));
                bw = hn::Add(bw, hn::MulAdd(v, gw, gb));
            }
        }
        const float sums[3][3] = {{sum(aa), 0.5f * sum(ab), 0.5f * sum(aw)},
                                  {0.5f * sum(ab), sum(bb), 0.5f * sum(bw)},
                                  {0.5f * sum(aw), 0.5f * sum(bw), sum(ww)}};
        for (int k = 0; k < 3; ++k) {
            force[face.axis[k]] -= face.sign[k] * sum(push[k]);
            for (int l = 0; l < 3; ++l)
                jacobian[face.axis[k]][face.axis[l]] += face.sign[k] * face.sign[l] * sums[k][l];
        }
    }
    EyeRecord out;
    out.force = force;
    out.jacobian = {jacobian[0][0], jacobian[1][1], jacobian[2][2],
                    jacobian[0][1], jacobian[0][2], jacobian[1][2]};
    const float inverse = hn::GetLane(hn::MaxOfLanes(d, nearest));
    if (inverse > 0.0f) out.nearest = 1.0f / inverse;
    out.hit_fraction = sum(hits);
    if (out.hit_fraction > 0.0f) out.back_fraction = sum(backs) / out.hit_fraction;
    if (glm::length(force) > 0.0f) out.clearance = clearance_ahead(grid, buffer, force);
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace zskel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "zskel/core/instruction_set.h"

namespace zskel {

EyeRecord summarize_zbuffer(const Surface& surface, const TexelGrid& grid, const ZBuffer& buffer) {
    return ZSKEL_DISPATCH(summarize)(surface, grid, buffer);
}

}  // namespace zskel
#endif  // HWY_ONCE
