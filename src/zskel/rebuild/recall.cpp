// The surface from the maps alone (the paper's section 6): signed distances to the planes that
// nodes saw, averaged as range images are (Curless and Levoy 1996), but only where a node's texels
// tell something, and with what any node saw past taken as inside: a solid is the union of what its
// nodes see.
#include "zskel/rebuild/recall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "zskel/core/lattice_hash.h"
#include "zskel/core/parallel.h"

namespace zskel {
namespace {

// Four texels whose depths differ by more than this factor are taken to lie on two surfaces: what
// is farther is not believed.
constexpr float kMostDepthRatio = 1.5f;
// Four texels see a crease when the plane that one sees passes another's depth by this share of it.
// Smooth walls stay below, h^2 D / 2 R for texels of width h = 1/16, walls at D and radii R > D
// / 5.
constexpr float kCreaseShare = 0.01f;
// What is extrapolated past a face's last texels is at least this share of the least of them.
constexpr double kLeastBeyond = 0.9;
// Within so many texels of a plane a sighting tells where the surface is; farther before it, that
// there is none.
constexpr double kNearFootprints = 1.5;

// So many of the nearest nodes that see a cube tell of it: the others' texels are wider there.
constexpr std::size_t kMostMaps = 32;

int face_of(const DVec3& direction) {
    const DVec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
}

// In a face's own axes: right, up, forward.
DVec3 in_face(const DVec3& direction, int face) {
    const CubeFace& axes = cube_faces()[static_cast<std::size_t>(face)];
    return {glm::dot(direction, DVec3(axes.right)), glm::dot(direction, DVec3(axes.up)),
            glm::dot(direction, DVec3(axes.forward))};
}

DVec3 from_face(const DVec3& local, int face) {
    const CubeFace& axes = cube_faces()[static_cast<std::size_t>(face)];
    return DVec3(axes.right) * local.x + DVec3(axes.up) * local.y + DVec3(axes.forward) * local.z;
}

}  // namespace

RecallMap::RecallMap(const NodeMap& node, int face_px) : eye_(node.eye), face_px_(face_px) {
    const std::size_t side = static_cast<std::size_t>(face_px) + 2;
    inverse_depth_.assign(6 * side * side, 0.0f);
    float nearest = std::numeric_limits<float>::infinity();
    for (const float d : node.distance) {
        nearest = std::min(nearest, d);
        if (std::isfinite(d)) farthest_ = std::max(farthest_, static_cast<double>(d));
    }
    for (std::size_t i = 0; i < node.distance.size(); ++i) {
        const Texel at = texel_at(i, face_px);
        const float d = std::isfinite(node.distance[i]) ? node.distance[i] : nearest;
        const auto length = static_cast<float>(glm::length(texel_direction(at, face_px)));
        if (std::isfinite(d) && d > 0.0f) texel(at.face, at.column, at.row) = length / d;
    }
    fill_border();
    find_creases();
}

float RecallMap::texel(int face, int column, int row) const {
    const int side = face_px_ + 2;
    const int at = (face * side + row + 1) * side + column + 1;
    return inverse_depth_[static_cast<std::size_t>(at)];
}
float& RecallMap::texel(int face, int column, int row) {
    const int side = face_px_ + 2;
    const int at = (face * side + row + 1) * side + column + 1;
    return inverse_depth_[static_cast<std::size_t>(at)];
}

std::size_t RecallMap::quad(int face, int column, int row) const {
    const int side = face_px_ + 1;
    const int at = (face * side + row + 1) * side + column + 1;
    return static_cast<std::size_t>(at);
}

// From the faces beside: half a texel over a face's edge lies half a texel within the next one.
void RecallMap::fill_border() {
    const double px = face_px_;
    const auto fill = [&](int face, int column, int row) {
        const DVec3 direction = texel_direction({face, column, row}, face_px_);
        const int other = face_of(direction);
        const DVec3 local = in_face(direction, other);
        const auto place = [&](double share) {
            return std::max(0.5 * px * (share / local.z + 1.0) - 0.5, 0.0);
        };
        const double x = place(local.x);
        const double y = place(local.y);
        const int i = std::min(static_cast<int>(x), face_px_ - 2);
        const int j = std::min(static_cast<int>(y), face_px_ - 2);
        const double fx = x - i;
        const double fy = y - j;
        const double inverse =
            (1.0 - fy) * ((1.0 - fx) * texel(other, i, j) + fx * texel(other, i + 1, j)) +
            fy * ((1.0 - fx) * texel(other, i, j + 1) + fx * texel(other, i + 1, j + 1));
        // Beyond the last texel by a little: where depths jump there, not out to infinity.
        const double least = std::min({texel(other, i, j), texel(other, i + 1, j),
                                       texel(other, i, j + 1), texel(other, i + 1, j + 1)});
        texel(face, column, row) =
            static_cast<float>(std::max(inverse, kLeastBeyond * least) * local.z);
    };
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < face_px_; ++i) {
            fill(face, i, -1);
            fill(face, i, face_px_);
            fill(face, -1, i);
            fill(face, face_px_, i);
        }
        const int last = face_px_ - 1;
        for (const int c : {-1, face_px_}) {
            for (const int r : {-1, face_px_}) {
                // Three faces meet there: the plane through the three texels beside.
                const int i = std::clamp(c, 0, last);
                const int j = std::clamp(r, 0, last);
                texel(face, c, r) = texel(face, i, r) + texel(face, c, j) - texel(face, i, j);
            }
        }
    }
}

// By the differences to the texels before and after, within the face: those that bend least count
// most (as in weighted essentially non-oscillatory schemes), so that a crease beside it is not in
// it.
Vec3 RecallMap::plane_of(const Texel& at) const {
    const float here = texel(at.face, at.column, at.row);
    const auto slope = [&](int place, auto&& depth) {
        float sum = 0.0f;
        float weights = 0.0f;
        for (const int side : {-1, 1}) {
            const int far = place + 2 * side;
            if (far < 0 || far >= face_px_) continue;
            const float step = depth(place + side) - here;
            const float bend = (depth(far) - depth(place + side) - step) / here;
            const float weight = 1.0f / (1e-8f + bend * bend);
            // The parabola's slope through the three.
            sum += weight * static_cast<float>(side) * (step - 0.5f * bend * here);
            weights += weight;
        }
        return sum / weights * 0.5f * static_cast<float>(face_px_);
    };
    const float a = slope(at.column, [&](int c) { return texel(at.face, c, at.row); });
    const float b = slope(at.row, [&](int r) { return texel(at.face, at.column, r); });
    const DVec3 along = texel_direction(at, face_px_);
    const DVec3 place = in_face(along, at.face);
    const double c = here - a * place.x - b * place.y;
    return Vec3(from_face({a, b, c}, at.face));
}

void RecallMap::find_creases() {
    const int px = face_px_;
    const auto side = static_cast<std::size_t>(px);
    std::vector<Vec3> planes(6 * side * side);
    for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = plane_of(texel_at(i, px));
    crease_of_.assign(quad(5, px - 1, px - 1) + 1, kNone);
    for (int face = 0; face < 6; ++face) {
        for (int row = -1; row < px; ++row) {
            for (int column = -1; column < px; ++column) {
                const std::optional<Crease> crease = crease_in({face, column, row}, planes);
                if (!crease) continue;
                crease_of_[quad(face, column, row)] = static_cast<std::uint32_t>(creases_.size());
                creases_.push_back(*crease);
            }
        }
    }
}

// Of the four texels from `first` on; `planes` are what every texel sees.
std::optional<RecallMap::Crease> RecallMap::crease_in(const Texel& first,
                                                      std::span<const Vec3> planes) const {
    Crease crease;
    std::array<Vec3, 4> along{};
    std::array<float, 4> inverse{};
    for (int k = 0; k < 4; ++k) {
        const Texel at{first.face, first.column + k % 2, first.row + k / 2};
        const DVec3 direction = texel_direction(at, face_px_);
        crease.planes[k] = planes[texel_index(texel_of_direction(direction, face_px_), face_px_)];
        along[k] = Vec3(direction);
        inverse[k] = texel(at.face, at.column, at.row);
    }
    const auto [least, most] = std::minmax_element(inverse.begin(), inverse.end());
    if (*most > *least * kMostDepthRatio) return std::nullopt;
    float below = 0.0f;
    float above = 0.0f;
    for (int k = 0; k < 4; ++k) {
        for (int l = 0; l < 4; ++l) {
            const float past = glm::dot(crease.planes[k], along[l]) - inverse[l];
            below = std::max(below, -past / inverse[l]);
            above = std::max(above, past / inverse[l]);
        }
    }
    // Planes that pass one another's texels on both sides do not meet here, nor do those that pass
    // them by as much as depths of two surfaces differ: such a plane was fitted across a jump.
    const bool is_crossed = std::min(below, above) > 0.5f * kCreaseShare;
    const bool is_jump = above > kMostDepthRatio - 1.0f || below > 1.0f - 1.0f / kMostDepthRatio;
    if (std::max(below, above) < kCreaseShare || is_crossed || is_jump) return std::nullopt;
    crease.is_convex = below > above;
    return crease;
}

// The plane on the direction's side of the quad's crease; none where there is no crease, or where
// the planes would lie behind all that the quad's texels see: an edge that points at the eye lies
// before them, one that points away not far behind.
const Vec3* RecallMap::beside_crease(std::size_t quad, const DVec3& direction,
                                     double farthest) const {
    const std::uint32_t number = crease_of_[quad];
    if (number == kNone) return nullptr;
    const auto& [planes, is_convex] = creases_[number];
    const auto ahead = [&](const Vec3& p) { return glm::dot(DVec3(p), direction); };
    const auto [far, near] = std::ranges::minmax_element(planes, {}, ahead);
    const Vec3* plane = is_convex ? &*near : &*far;
    return ahead(*plane) * (is_convex ? kMostDepthRatio : 1.0) >= farthest ? plane : nullptr;
}

Sighting RecallMap::look_at(const DVec3& place) const {
    const DVec3 direction = place - eye_;
    if (direction == DVec3(0.0)) return {farthest_, 0.0, DVec3(0.0)};
    const int face = face_of(direction);
    const DVec3 local = in_face(direction, face);
    const double depth = local.z;
    const double texel_width = 2.0 / face_px_;
    const double x = (local.x / depth + 1.0) / texel_width - 0.5;
    const double y = (local.y / depth + 1.0) / texel_width - 0.5;
    const int i = std::clamp(static_cast<int>(std::floor(x)), -1, face_px_ - 1);
    const int j = std::clamp(static_cast<int>(std::floor(y)), -1, face_px_ - 1);
    const float q00 = texel(face, i, j);
    const float q10 = texel(face, i + 1, j);
    const float q01 = texel(face, i, j + 1);
    const float q11 = texel(face, i + 1, j + 1);
    const float most = std::max({q00, q10, q01, q11});
    const float least = std::min({q00, q10, q01, q11});
    // a X + b Y + c Z = 1 in the face's axes.
    DVec3 plane(0.0, 0.0, most);
    bool is_jump = false;
    const Vec3* beside = beside_crease(quad(face, i, j), direction, least * depth);
    if (beside != nullptr) {
        plane = in_face(DVec3(*beside), face);
    } else if (most <= least * kMostDepthRatio) {
        const double fx = x - i;
        const double fy = y - j;
        const double a = ((q10 - q00) * (1.0 - fy) + (q11 - q01) * fy) / texel_width;
        const double b = ((q01 - q00) * (1.0 - fx) + (q11 - q10) * fx) / texel_width;
        const double q =
            (q00 * (1.0 - fx) + q10 * fx) * (1.0 - fy) + (q01 * (1.0 - fx) + q11 * fx) * fy;
        plane = DVec3(a, b, q - (a * local.x + b * local.y) / depth);
    } else {
        is_jump = true;
    }
    const double steepness = glm::length(plane);
    if (!(steepness > 0.0)) return {-glm::length(direction), 0.0, DVec3(0.0)};
    return {(1.0 - glm::dot(plane, local)) / steepness, texel_width * depth,
            from_face(plane / steepness, face), is_jump};
}

Recall::Recall(const VisibilityMaps& maps) : face_px_(maps.face_px) {
    maps_.reserve(maps.nodes.size());
    for (const NodeMap& node : maps.nodes) maps_.emplace_back(node, maps.face_px);
}

double Recall::inside(const DVec3& place, const std::vector<std::uint32_t>& among) const {
    double surely = -std::numeric_limits<double>::infinity();
    double nearest = surely;
    double sum = 0.0;
    double weights = 0.0;
    for (const std::uint32_t m : among) {
        const Sighting seen = maps_[m].look_at(place);
        const double doubt = kNearFootprints * seen.footprint;
        surely = std::max(surely, seen.inside - doubt);
        nearest = std::max(nearest, seen.inside);
        if (std::abs(seen.inside) > doubt) continue;
        const double weight = 1.0 / (seen.footprint * seen.footprint);
        sum += weight * seen.inside;
        weights += weight;
    }
    if (surely > 0.0) return surely;
    return weights > 0.0 ? sum / weights : nearest;
}

std::vector<std::uint32_t> Recall::maps_about(const DVec3& middle, double half_side) const {
    std::vector<std::uint32_t> out;
    const double reach = std::sqrt(3.0) * half_side;
    for (std::uint32_t m = 0; m < maps_.size(); ++m) {
        if (glm::distance(maps_[m].eye(), middle) - reach > maps_[m].farthest()) continue;
        for (int corner = 0; corner < 27; ++corner) {
            const DVec3 step(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
            const Sighting seen = maps_[m].look_at(middle + half_side * step);
            if (seen.inside < -kNearFootprints * seen.footprint - half_side) continue;
            out.push_back(m);
            break;
        }
    }
    if (out.size() > kMostMaps) {
        const auto nearer = [&](std::uint32_t l, std::uint32_t r) {
            const double of_l = glm::distance(maps_[l].eye(), middle);
            const double of_r = glm::distance(maps_[r].eye(), middle);
            return of_l != of_r ? of_l < of_r : l < r;
        };
        std::nth_element(out.begin(), out.begin() + kMostMaps, out.end(), nearer);
        out.resize(kMostMaps);
        std::sort(out.begin(), out.end());
    }
    return out;
}

std::vector<Surfel> Recall::surfels() const {
    std::vector<std::vector<Surfel>> found(maps_.size());
    const auto side = static_cast<std::size_t>(face_px_);
    const std::size_t texels = 6 * side * side;
    parallel_for(maps_.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            for (std::size_t t = 0; t < texels; ++t) {
                const DVec3 ray = texel_direction(texel_at(t, face_px_), face_px_);
                // The plane in that direction, and where the ray meets it.
                const DVec3 probe = maps_[m].eye() + ray * maps_[m].farthest();
                const Sighting seen = maps_[m].look_at(probe);
                const double facing = glm::dot(seen.outward, ray);
                if (seen.is_jump || !(facing > 0.0)) continue;
                const double way = maps_[m].farthest() + seen.inside / facing;
                found[m].push_back({maps_[m].eye() + ray * way, seen.outward,
                                    2.0 / face_px_ * way * glm::length(ray) / facing});
            }
        }
    });
    std::vector<Surfel> out;
    for (const std::vector<Surfel>& of_map : found)
        out.insert(out.end(), of_map.begin(), of_map.end());
    return out;
}

std::vector<Surfel> merge_surfels(const std::vector<Surfel>& surfels, double cell) {
    std::unordered_map<glm::i64vec3, std::size_t, LatticeHash> known;
    std::vector<Surfel> out;
    for (const Surfel& s : surfels) {
        const auto [place, is_new] = known.try_emplace(cell_of(s.position, cell), out.size());
        if (is_new) {
            out.push_back(s);
        } else if (s.spacing < out[place->second].spacing) {
            out[place->second] = s;
        }
    }
    return out;
}

}  // namespace zskel
