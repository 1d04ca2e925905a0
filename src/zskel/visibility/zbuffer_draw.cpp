// The rasteriser, compiled once for every instruction set. On a face with axes (right, up, forward)
// a direction is (u, v, 1); a triangle with corners p0 p1 p2 as seen from the eye covers it where
// the three products e0.d, e1.d, e2.d with e0 = p1 x p2 and so on have one sign, and is met at
// 1/z = g.d with g = n / (n.p0): all are linear in u and v, and nothing has to be clipped. Two
// triangles that share an edge compute exactly opposite values there, as long as no multiplication
// is fused into the subtraction of a cross product (-ffp-contract=off), so nothing shows between.
#include "zskel/core/simd_targets.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/zbuffer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "zskel/visibility/zbuffer_draw.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace zskel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBlock>;
using IntTag = hn::RebindToSigned<Tag>;
using F = hn::Vec<Tag>;

// Corners nearer than this to the plane through the eye count as behind it.
constexpr float kLeastAxial = 1e-12f;
// Boxes are widened by this share of a face: rounding in the edges, and a reciprocal of 11 bits,
// move a triangle's border by less.
constexpr float kSlack = 3e-4f;
constexpr float kPadding = 1e15f;

template <typename Mask>
unsigned bits_of(Mask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return bits[0] | (static_cast<unsigned>(bits[1]) << 8);
}

// Where on a face something may show; in texels, as floats.
struct Rect {
    F first_column, last_column, first_row, last_row;
};

struct FaceGrid {
    float half;    // texels from the middle of a face to its border
    float middle;  // index of the middle
    float last;    // index of the last texel
    float slack;
    float width;   // of a texel, in face coordinates
    float centre;  // of the first texel

    explicit FaceGrid(int n)
        : half(0.5f * static_cast<float>(n)),
          middle(0.5f * static_cast<float>(n - 1)),
          last(static_cast<float>(n - 1)),
          slack(kSlack * static_cast<float>(n)),
          width(2.0f / static_cast<float>(n)),
          centre(1.0f / static_cast<float>(n) - 1.0f) {}

    // Centres of texels: always by this one formula, so that no two places of the code differ.
    F at(F index) const {
        const Tag d;
        return hn::MulAdd(index, hn::Set(d, width), hn::Set(d, centre));
    }

    F first(F u) const {
        const Tag d;
        const F at = hn::Ceil(hn::MulAdd(u, hn::Set(d, half), hn::Set(d, middle - slack)));
        return hn::Max(at, hn::Zero(d));
    }
    F past(F u) const {
        const Tag d;
        const F at = hn::Floor(hn::MulAdd(u, hn::Set(d, half), hn::Set(d, middle + slack)));
        return hn::Min(at, hn::Set(d, last));
    }
};

// Sixteen boxes as an eye sees them.
struct BoxesFrom {
    BoxesFrom(const BoxBlock& boxes, std::size_t o, const Vec3& eye) {
        const Tag d;
        for (int k = 0; k < 3; ++k) {
            const F e = hn::Set(d, eye[k]);
            low[k] = hn::Sub(hn::Load(d, &boxes.low[k][o]), e);
            high[k] = hn::Sub(hn::Load(d, &boxes.high[k][o]), e);
        }
    }
    F low[3];
    F high[3];
};

// Calls `take(lane, candidate)` for every box that holds a texel's centre of a face; the candidate
// has no group yet.
template <typename Take>
void for_each_shown(const BoxesFrom& boxes, const FaceAxes& face, const FaceGrid& texels,
                    const Take& take) {
    const Tag d;
    const IntTag di;
    const F zero = hn::Zero(d);
    const F one = hn::Set(d, 1.0f);
    F lo[3];
    F hi[3];
    for (int k = 0; k < 3; ++k) {
        const int axis = face.axis[k];
        lo[k] = face.sign[k] > 0.0f ? boxes.low[axis] : hn::Neg(boxes.high[axis]);
        hi[k] = face.sign[k] > 0.0f ? boxes.high[axis] : hn::Neg(boxes.low[axis]);
    }
    auto shows = hn::Gt(hi[2], zero);
    if (hn::AllFalse(d, shows)) return;
    const F near_inverse = hn::IfThenElse(hn::Gt(lo[2], hn::Set(d, kLeastAxial)),
                                          hn::Div(one, lo[2]), hn::Set(d, 1.0f / kLeastAxial));
    const F far_inverse = hn::Div(one, hi[2]);
    const auto low_edge = [&](F a) {
        return hn::Mul(a, hn::IfThenElse(hn::Lt(a, zero), near_inverse, far_inverse));
    };
    const auto high_edge = [&](F a) {
        return hn::Mul(a, hn::IfThenElse(hn::Gt(a, zero), near_inverse, far_inverse));
    };
    const Rect r{texels.first(low_edge(lo[0])), texels.past(high_edge(hi[0])),
                 texels.first(low_edge(lo[1])), texels.past(high_edge(hi[1]))};
    shows = hn::And(
        shows, hn::And(hn::Le(r.first_column, r.last_column), hn::Le(r.first_row, r.last_row)));
    if (hn::AllFalse(d, shows)) return;
    HWY_ALIGN float inverse_near[kBlock];
    HWY_ALIGN std::int32_t rect[4][kBlock];
    hn::Store(near_inverse, d, inverse_near);
    hn::Store(hn::ConvertTo(di, r.first_column), di, rect[0]);
    hn::Store(hn::ConvertTo(di, r.last_column), di, rect[1]);
    hn::Store(hn::ConvertTo(di, r.first_row), di, rect[2]);
    hn::Store(hn::ConvertTo(di, r.last_row), di, rect[3]);
    for (unsigned mask = bits_of(shows); mask != 0; mask &= mask - 1) {
        const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(mask);
        ZBuffer::Candidate c{inverse_near[i], 0, {}};
        for (std::size_t k = 0; k < 4; ++k) c.rect[k] = static_cast<std::uint16_t>(rect[k][i]);
        take(i, c);
    }
}

void list_groups(const TriangleClusters& clusters, const TexelGrid& grid, const Vec3& eye,
                 ZBuffer& buffer) {
    const FaceGrid texels(grid.face_px);
    for (auto& list : buffer.candidates) list.clear();
    for (std::size_t b = 0; b < clusters.group_boxes.size(); ++b) {
        for (std::size_t o = 0; o < kBlock; o += hn::Lanes(Tag())) {
            const BoxesFrom boxes(clusters.group_boxes[b], o, eye);
            for (std::size_t f = 0; f < 6; ++f) {
                for_each_shown(boxes, grid.faces[f], texels,
                               [&](std::size_t lane, ZBuffer::Candidate c) {
                                   c.group = static_cast<std::uint32_t>(b * kBlock + o + lane);
                                   buffer.candidates[f].push_back(c);
                               });
            }
        }
    }
}

// The order of candidates from near to far; many go by buckets of an eighth of an octave.
void sort_near_to_far(const std::vector<ZBuffer::Candidate>& list,
                      std::vector<std::uint32_t>& order) {
    constexpr std::size_t kFew = 32;
    constexpr std::uint32_t kBuckets = 256;
    order.resize(list.size());
    if (list.size() <= kFew) {
        for (std::uint32_t i = 0; i < list.size(); ++i) {
            std::uint32_t at = i;
            for (; at > 0 && list[order[at - 1]].inverse_near < list[i].inverse_near; --at)
                order[at] = order[at - 1];
            order[at] = i;
        }
        return;
    }
    const auto bucket_of = [](float inverse_near) {
        constexpr std::uint32_t kOne = 0x3F800000u >> 20;  // inverse_near is about 1 or more
        const std::uint32_t octaves = std::bit_cast<std::uint32_t>(inverse_near) >> 20;
        return kBuckets - 1 - std::min(octaves - std::min(octaves, kOne), kBuckets - 1);
    };
    std::uint32_t start[kBuckets + 1] = {};
    for (const ZBuffer::Candidate& c : list) ++start[bucket_of(c.inverse_near) + 1];
    for (std::uint32_t i = 0; i < kBuckets; ++i) start[i + 1] += start[i];
    for (std::uint32_t i = 0; i < list.size(); ++i)
        order[start[bucket_of(list[i].inverse_near)]++] = i;
}

// Whether all that is in the candidate's rectangle is nearer than the candidate can be.
bool is_hidden(const ZBuffer::Candidate& c, const TexelGrid& grid, const float* depth) {
    const Tag d;
    const std::size_t lanes = hn::Lanes(d);
    const F bound = hn::Set(d, c.inverse_near);
    const std::size_t begin = c.rect[0] / lanes * lanes;
    for (std::size_t column = begin; column <= c.rect[1]; column += lanes) {
        const F at = hn::Iota(d, static_cast<float>(column));
        const auto inside = hn::And(hn::Ge(at, hn::Set(d, static_cast<float>(c.rect[0]))),
                                    hn::Le(at, hn::Set(d, static_cast<float>(c.rect[1]))));
        F least = hn::Set(d, kPadding);
        for (std::size_t row = c.rect[2]; row <= c.rect[3]; ++row)
            least = hn::Min(least, hn::Load(d, depth + row * grid.stride + column));
        if (!hn::AllFalse(d, hn::And(inside, hn::Lt(least, bound)))) return false;
    }
    return true;
}

class FaceDrawer {
  public:
    FaceDrawer(const TexelGrid& grid, const FaceAxes& axes, const Vec3& eye, float* depth,
               std::uint32_t* id)
        : grid_(grid), axes_(axes), texels_(grid.face_px), depth_(depth), id_(id) {
        for (int k = 0; k < 3; ++k) shift_[k] = -axes.sign[k] * eye[axes.axis[k]];
    }

    void draw(const TriangleBlock& block) const {
        for (std::size_t o = 0; o < kBlock; o += hn::Lanes(Tag())) draw_lanes(block, o);
    }

  private:
    struct Point {
        F a, b, w;  // right, up, forward
    };

    Point corner(const TriangleBlock& block, std::size_t first, std::size_t o) const {
        const Tag d;
        const auto at = [&](int k) {
            const auto axis = static_cast<std::size_t>(axes_.axis[k]);
            return hn::MulAdd(hn::Set(d, axes_.sign[k]),
                              hn::Load(d, &block.corner[first + axis][o]), hn::Set(d, shift_[k]));
        };
        return {at(0), at(1), at(2)};
    }

    // The axes (right, up, forward) are left-handed.
    static Point cross(const Point& p, const Point& q) {
        return {hn::Sub(hn::Mul(p.w, q.b), hn::Mul(p.b, q.w)),
                hn::Sub(hn::Mul(p.a, q.w), hn::Mul(p.w, q.a)),
                hn::Sub(hn::Mul(p.b, q.a), hn::Mul(p.a, q.b))};
    }

    static F in_column(const Point& g, F u) { return hn::MulAdd(g.a, u, g.w); }
    static F at(const Point& g, F u, F v) { return hn::MulAdd(g.b, v, in_column(g, u)); }

    void draw_lanes(const TriangleBlock& block, std::size_t o) const {
        const Tag d;
        const IntTag di;
        const F zero = hn::Zero(d);
        const F one = hn::Set(d, 1.0f);
        const Point p0 = corner(block, 0, o);
        const Point p1 = corner(block, 3, o);
        const Point p2 = corner(block, 6, o);
        const auto least = [](F a, F b, F c) { return hn::Min(hn::Min(a, b), c); };
        const auto most = [](F a, F b, F c) { return hn::Max(hn::Max(a, b), c); };
        auto shows = hn::Gt(most(p0.w, p1.w, p2.w), zero);
        if (hn::AllFalse(d, shows)) return;

        Rect rect;
        {
            const F i0 = hn::ApproximateReciprocal(p0.w);
            const F i1 = hn::ApproximateReciprocal(p1.w);
            const F i2 = hn::ApproximateReciprocal(p2.w);
            const F a0 = hn::Mul(p0.a, i0);
            const F a1 = hn::Mul(p1.a, i1);
            const F a2 = hn::Mul(p2.a, i2);
            const F b0 = hn::Mul(p0.b, i0);
            const F b1 = hn::Mul(p1.b, i1);
            const F b2 = hn::Mul(p2.b, i2);
            F left = least(a0, a1, a2);
            F right = most(a0, a1, a2);
            F low = least(b0, b1, b2);
            F high = most(b0, b1, b2);
            const auto crosses = hn::Lt(least(p0.w, p1.w, p2.w), hn::Set(d, kLeastAxial));
            if (!hn::AllFalse(d, crosses)) {
                left = hn::IfThenElse(crosses, hn::Neg(one), left);
                right = hn::IfThenElse(crosses, one, right);
                low = hn::IfThenElse(crosses, hn::Neg(one), low);
                high = hn::IfThenElse(crosses, one, high);
                // Beyond one of the four planes of the face's pyramid with all three corners.
                const auto beyond = [&](F x0, F x1, F x2) {
                    return hn::Gt(least(hn::Sub(x0, p0.w), hn::Sub(x1, p1.w), hn::Sub(x2, p2.w)),
                                  zero);
                };
                const auto out =
                    hn::Or(hn::Or(beyond(p0.a, p1.a, p2.a),
                                  beyond(hn::Neg(p0.a), hn::Neg(p1.a), hn::Neg(p2.a))),
                           hn::Or(beyond(p0.b, p1.b, p2.b),
                                  beyond(hn::Neg(p0.b), hn::Neg(p1.b), hn::Neg(p2.b))));
                shows = hn::AndNot(hn::And(out, crosses), shows);
            }
            rect = {texels_.first(left), texels_.past(right), texels_.first(low),
                    texels_.past(high)};
        }
        shows = hn::And(shows, hn::And(hn::Le(rect.first_column, rect.last_column),
                                       hn::Le(rect.first_row, rect.last_row)));
        if (hn::AllFalse(d, shows)) return;

        const auto normal_at = [&](int k) {
            const auto axis = static_cast<std::size_t>(axes_.axis[k]);
            return hn::Mul(hn::Set(d, axes_.sign[k]), hn::Load(d, &block.normal[axis][o]));
        };
        const Point n{normal_at(0), normal_at(1), normal_at(2)};
        const F height = hn::MulAdd(n.a, p0.a, hn::MulAdd(n.b, p0.b, hn::Mul(n.w, p0.w)));
        shows = hn::And(shows, hn::Gt(hn::Abs(height), hn::Set(d, kNearPlane)));
        if (hn::AllFalse(d, shows)) return;

        const F sign = hn::And(height, hn::SignBit(d));
        const auto turned = [&](const Point& e) {
            return Point{hn::Xor(e.a, sign), hn::Xor(e.b, sign), hn::Xor(e.w, sign)};
        };
        const Point e0 = turned(cross(p1, p2));
        const Point e1 = turned(cross(p2, p0));
        const Point e2 = turned(cross(p0, p1));
        const F inverse_height = hn::Div(one, height);
        const Point g{hn::Mul(n.a, inverse_height), hn::Mul(n.b, inverse_height),
                      hn::Mul(n.w, inverse_height)};

        // Most boxes hold one texel: all lanes look at theirs at once.
        const auto single = hn::And(shows, hn::And(hn::Eq(rect.first_column, rect.last_column),
                                                   hn::Eq(rect.first_row, rect.last_row)));
        if (!hn::AllFalse(d, single)) {
            const F u = texels_.at(rect.first_column);
            const F v = texels_.at(rect.first_row);
            const F inside = least(at(e0, u, v), at(e1, u, v), at(e2, u, v));
            const F inverse = at(g, u, v);
            const auto drawn =
                hn::And(single, hn::And(hn::Ge(inside, zero), hn::Gt(inverse, zero)));
            if (!hn::AllFalse(d, drawn)) {
                HWY_ALIGN float inverses[kBlock];
                HWY_ALIGN std::int32_t texels[kBlock];
                hn::Store(inverse, d, inverses);
                const F stride = hn::Set(d, static_cast<float>(grid_.stride));
                const F texel = hn::MulAdd(rect.first_row, stride, rect.first_column);
                hn::Store(hn::ConvertTo(di, texel), di, texels);
                for (unsigned mask = bits_of(drawn); mask != 0; mask &= mask - 1) {
                    const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(mask);
                    float& depth = depth_[texels[i]];
                    std::uint32_t& id = id_[texels[i]];
                    const std::uint32_t name = block.id[o + i];
                    if (inverses[i] > depth || (inverses[i] == depth && name < id)) {
                        depth = inverses[i];
                        id = name;
                    }
                }
            }
        }

        const auto wide = hn::AndNot(single, shows);
        if (hn::AllFalse(d, wide)) return;
        HWY_ALIGN float lines[12][kBlock];
        const Point* const points[4] = {&e0, &e1, &e2, &g};
        for (int k = 0; k < 4; ++k) {
            hn::Store(points[k]->a, d, lines[3 * k]);
            hn::Store(points[k]->b, d, lines[3 * k + 1]);
            hn::Store(points[k]->w, d, lines[3 * k + 2]);
        }
        HWY_ALIGN std::int32_t rects[4][kBlock];
        hn::Store(hn::ConvertTo(di, rect.first_column), di, rects[0]);
        hn::Store(hn::ConvertTo(di, rect.last_column), di, rects[1]);
        hn::Store(hn::ConvertTo(di, rect.first_row), di, rects[2]);
        hn::Store(hn::ConvertTo(di, rect.last_row), di, rects[3]);
        for (unsigned mask = bits_of(wide); mask != 0; mask &= mask - 1) {
            const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(mask);
            draw_rows(lines, rects, i, block.id[o + i]);
        }
    }

    void draw_rows(const float (&lines)[12][kBlock], const std::int32_t (&rects)[4][kBlock],
                   std::size_t i, std::uint32_t triangle) const {
        const Tag d;
        const IntTag di;
        const std::size_t lanes = hn::Lanes(d);
        const auto line = [&](int k) { return hn::Set(d, lines[k][i]); };
        const auto last_column = static_cast<std::size_t>(rects[1][i]);
        const auto first_row = static_cast<std::size_t>(rects[2][i]);
        const auto last_row = static_cast<std::size_t>(rects[3][i]);
        const auto name = hn::Set(di, static_cast<std::int32_t>(triangle));
        for (std::size_t column = static_cast<std::size_t>(rects[0][i]) / lanes * lanes;
             column <= last_column; column += lanes) {
            const F u = texels_.at(hn::Iota(d, static_cast<float>(column)));
            const F c0 = hn::MulAdd(line(0), u, line(2));
            const F c1 = hn::MulAdd(line(3), u, line(5));
            const F c2 = hn::MulAdd(line(6), u, line(8));
            const F c3 = hn::MulAdd(line(9), u, line(11));
            for (std::size_t row = first_row; row <= last_row; ++row) {
                const F v = texels_.at(hn::Set(d, static_cast<float>(row)));
                const F inside =
                    hn::Min(hn::Min(hn::MulAdd(line(1), v, c0), hn::MulAdd(line(4), v, c1)),
                            hn::MulAdd(line(7), v, c2));
                const F inverse = hn::MulAdd(line(10), v, c3);
                const std::size_t texel = row * grid_.stride + column;
                float* depth = depth_ + texel;
                auto* id = reinterpret_cast<std::int32_t*>(id_ + texel);
                const F old_depth = hn::Load(d, depth);
                const auto old_id = hn::Load(di, id);
                const auto wins = hn::Or(
                    hn::Gt(inverse, old_depth),
                    hn::And(hn::Eq(inverse, old_depth), hn::RebindMask(d, hn::Lt(name, old_id))));
                const auto drawn = hn::And(hn::Ge(inside, hn::Zero(d)), wins);
                hn::Store(hn::IfThenElse(drawn, inverse, old_depth), d, depth);
                hn::Store(hn::IfThenElse(hn::RebindMask(di, drawn), name, old_id), di, id);
            }
        }
    }

    const TexelGrid& grid_;
    const FaceAxes& axes_;
    FaceGrid texels_;
    float shift_[3];
    float* depth_;
    std::uint32_t* id_;
};

void draw(const TriangleClusters& clusters, const TexelGrid& grid, const Vec3& eye,
          ZBuffer& buffer) {
    const auto n = static_cast<std::size_t>(grid.face_px);
    std::fill(buffer.inverse_depth.begin(), buffer.inverse_depth.end(), 0.0f);
    std::fill(buffer.id.begin(), buffer.id.end(), kNone);
    if (n < grid.stride) {
        for (std::size_t row = 0; row < 6 * n; ++row) {
            std::fill_n(
                buffer.inverse_depth.begin() + static_cast<std::ptrdiff_t>(row * grid.stride + n),
                grid.stride - n, kPadding);
        }
    }
    list_groups(clusters, grid, eye, buffer);
    const FaceGrid texels(grid.face_px);
    for (std::size_t f = 0; f < 6; ++f) {
        float* depth = &buffer.inverse_depth[f * n * grid.stride];
        std::uint32_t* id = &buffer.id[f * n * grid.stride];
        const FaceDrawer drawer(grid, grid.faces[f], eye, depth, id);
        const std::vector<ZBuffer::Candidate>& list = buffer.candidates[f];
        sort_near_to_far(list, buffer.order);
        for (const std::uint32_t i : buffer.order) {
            if (is_hidden(list[i], grid, depth)) continue;
            const std::uint32_t group = list[i].group;
            for (std::size_t o = 0; o < kBlock; o += hn::Lanes(Tag())) {
                const BoxesFrom boxes(clusters.block_boxes[group], o, eye);
                for_each_shown(
                    boxes, grid.faces[f], texels,
                    [&](std::size_t lane, const ZBuffer::Candidate& c) {
                        if (is_hidden(c, grid, depth)) return;
                        drawer.draw(clusters.triangles[clusters.first_block[group] + o + lane]);
                    });
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace zskel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "zskel/core/instruction_set.h"

namespace zskel {

void draw_zbuffer(const TriangleClusters& clusters, const TexelGrid& grid, const Vec3& eye,
                  ZBuffer& buffer) {
    ZSKEL_DISPATCH(draw)(clusters, grid, eye, buffer);
}

}  // namespace zskel
#endif  // HWY_ONCE
