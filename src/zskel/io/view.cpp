#include "zskel/io/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "zskel/core/error.h"

namespace zskel {
namespace {

constexpr double kDistanceRadii = 5.0;  // camera to middle: a mild perspective
constexpr float kMargin = 0.06f;        // of the picture on each side
constexpr double kTurnDeg = 22.0;       // off the axis of least spread, so that depth shows
constexpr double kTiltDeg = 12.0;
constexpr double kFlatTiltDeg = 38.0;  // for what lies flat on the ground
constexpr double kFootShare = 0.03;    // of the height: what touches the ground
constexpr double kClearFoot = 1.5;     // how much wider the foot is than any other side's
constexpr double kLeastFoot = 0.1;     // of the ground plan

// Right, up and back (towards the camera): orthonormal.
struct Frame {
    DVec3 right;
    DVec3 up;
    DVec3 back;
};

[[noreturn]] void reject(std::string_view text) {
    throw UsageError(
        fmt::format("view '{}': give front, back, left, right, top, bottom, iso, or "
                    "AZIMUTH,ELEVATION in degrees "
                    "(elevation -90 to 90), with ',z' behind it when z is up",
                    text));
}

double parse_degrees(std::string_view text, double limit, std::string_view whole) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= limit))
        reject(whole);
    return value;
}

// The camera's frame on the sphere round (y up).
Frame turned(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
    const double elevation = elevation_deg * std::numbers::pi / 180.0;
    const DVec3 right(std::cos(azimuth), 0.0, -std::sin(azimuth));
    const DVec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                     std::cos(azimuth) * std::cos(elevation));
    return {right, glm::cross(back, right), back};
}

Frame frame_of(const View& view) {
    const Frame frame = turned(view.azimuth_deg, view.elevation_deg);
    if (!view.is_z_up) return frame;
    const auto raise = [](const DVec3& v) { return DVec3(v.x, -v.z, v.y); };
    return {raise(frame.right), raise(frame.up), raise(frame.back)};
}

glm::dmat3 covariance(const Surface& surface) {
    double total = 0.0;
    DVec3 mean(0.0);
    glm::dmat3 second(0.0);
    for (const Triangle& t : surface.triangles) {
        const DVec3 a(surface.positions[t.x]);
        const DVec3 b(surface.positions[t.y]);
        const DVec3 c(surface.positions[t.z]);
        const double area = glm::length(glm::cross(b - a, c - a));
        const DVec3 middle = (a + b + c) / 3.0;
        total += area;
        mean += area * middle;
        second += area * glm::outerProduct(middle, middle);
    }
    mean /= total;
    return second / total - glm::outerProduct(mean, mean);
}

// Eigenvectors of a symmetric matrix as columns, by Jacobi's rotations; least eigenvalue first.
glm::dmat3 principal_axes(glm::dmat3 m) {
    glm::dmat3 axes(1.0);
    for (int sweep = 0; sweep < 12; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (m[q][p] == 0.0) continue;
                const double angle = 0.5 * std::atan2(2.0 * m[q][p], m[q][q] - m[p][p]);
                glm::dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = std::cos(angle);
                turn[q][p] = std::sin(angle);
                turn[p][q] = -std::sin(angle);
                m = glm::transpose(turn) * m * turn;
                axes = axes * turn;
            }
        }
    }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return m[a][a] < m[b][b]; });
    return {axes[order[0]], axes[order[1]], axes[order[2]]};
}

// How much of the ground plan the points touch that lie lowest along an axis.
double foot_share(const Surface& surface, const Vec3& low, const Vec3& high, int axis,
                  bool is_flipped) {
    const float height = high[axis] - low[axis];
    const float reach = static_cast<float>(kFootShare) * height;
    Vec3 foot_low(kInfinity);
    Vec3 foot_high(-kInfinity);
    for (const Vec3& p : surface.positions) {
        const float above = is_flipped ? high[axis] - p[axis] : p[axis] - low[axis];
        if (above > reach) continue;
        foot_low = glm::min(foot_low, p);
        foot_high = glm::max(foot_high, p);
    }
    double share = 1.0;
    for (int side = 0; side < 3; ++side) {
        if (side != axis)
            share *= (foot_high[side] - foot_low[side]) / std::max(high[side] - low[side], 1e-9f);
    }
    return share;
}

// The coordinate axis on which the model stands: its foot is clearly wider than its other five
// sides.
std::optional<DVec3> standing_axis(const Surface& surface, const Vec3& low, const Vec3& high) {
    double best = 0.0;
    double second = 0.0;
    DVec3 up(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool is_flipped : {false, true}) {
            const double share = foot_share(surface, low, high, axis, is_flipped);
            if (share > best) {
                second = best;
                best = share;
                up = DVec3(0.0);
                up[axis] = is_flipped ? -1.0 : 1.0;
            } else {
                second = std::max(second, share);
            }
        }
    }
    if (best < kLeastFoot || best < kClearFoot * second) return std::nullopt;
    return up;
}

// Of the two signs, the one whose greatest component is positive.
DVec3 canonical(const DVec3& v) {
    int greatest = 2;  // of equals, prefer z, then y
    for (int i : {1, 0}) {
        if (std::abs(v[i]) > std::abs(v[greatest]) * (1.0 + 1e-6)) greatest = i;
    }
    return v[greatest] < 0.0 ? -v : v;
}

Frame default_frame(const Surface& surface, const Vec3& low, const Vec3& high) {
    const glm::dmat3 spread = covariance(surface);
    const std::optional<DVec3> standing = standing_axis(surface, low, high);
    glm::dmat3 axes = principal_axes(spread);
    double tilt = kTiltDeg;
    DVec3 up(0.0, 1.0, 0.0);
    if (standing) {
        up = *standing;
        if (std::abs(glm::dot(axes[0], up)) > 0.7) tilt = kFlatTiltDeg;
        // Spread along up is made the greatest, so that the least axis lies level.
        axes = principal_axes(spread + 10.0 * glm::outerProduct(up, up));
    } else if (std::abs(glm::dot(axes[0], up)) > 0.9) {
        up = canonical(axes[1]);  // lying: from above, the longest axis across
    }
    const DVec3 back = canonical(axes[0]);
    const DVec3 right = glm::normalize(glm::cross(up, back));
    const glm::dmat3 base(right, glm::cross(back, right), back);
    const Frame turn = turned(kTurnDeg, tilt);
    return {base * turn.right, base * turn.up, base * turn.back};
}

}  // namespace

View parse_view(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, View>, 7> kNamed{{
        {"front", {0, 0}},
        {"back", {180, 0}},
        {"left", {-90, 0}},
        {"right", {90, 0}},
        {"top", {0, 90}},
        {"bottom", {0, -90}},
        {"iso", {45, 35.26438968}},
    }};
    std::string_view rest = text;
    const bool is_z_up = rest.ends_with(",z");
    if (is_z_up) rest.remove_suffix(2);
    for (const auto& [name, view] : kNamed) {
        if (rest == name) return {view.azimuth_deg, view.elevation_deg, is_z_up};
    }
    const std::size_t comma = rest.find(',');
    if (comma == std::string_view::npos) reject(text);
    return {parse_degrees(rest.substr(0, comma), 360.0, text),
            parse_degrees(rest.substr(comma + 1), 90.0, text), is_z_up};
}

glm::mat4 Camera::clip_from_view(float bottom, float top) const {
    const float width = window.y - window.x;
    const float height = window.w - window.z;
    const float low = window.z + bottom * height;
    const float high = window.z + top * height;
    glm::mat4 clip(0.0f);
    clip[0][0] = 2.0f / width;
    clip[2][0] = (window.x + window.y) / width;
    clip[1][1] = 2.0f / (high - low);
    clip[2][1] = (low + high) / (high - low);
    clip[3][2] = near_plane;
    clip[2][3] = -1.0f;
    return clip;
}

glm::vec2 Camera::pixel_of(const Vec3& world, int width_px, int height_px) const {
    const glm::vec4 clip = clip_from_view() * view_from_world * glm::vec4(world, 1.0f);
    return {(clip.x / clip.w + 1.0f) * 0.5f * static_cast<float>(width_px),
            (1.0f - clip.y / clip.w) * 0.5f * static_cast<float>(height_px)};
}

Camera aim_camera(const Surface& surface, const std::optional<View>& view, int width_px,
                  int height_px) {
    Vec3 low(kInfinity);
    Vec3 high(-kInfinity);
    for (const Vec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const Frame frame = view ? frame_of(*view) : default_frame(surface, low, high);
    const DVec3 middle = DVec3(low + high) * 0.5;
    const double radius = 0.5 * glm::length(DVec3(high - low));
    Camera camera;
    camera.distance = static_cast<float>(kDistanceRadii * radius);
    camera.near_plane = static_cast<float>((kDistanceRadii - 3.0) * radius);
    const glm::dmat3 turn = glm::transpose(glm::dmat3(frame.right, frame.up, frame.back));
    camera.view_from_world = glm::mat4(turn);
    camera.view_from_world[3] =
        glm::vec4(Vec3(turn * -middle) - Vec3(0.0f, 0.0f, camera.distance), 1.0f);

    glm::vec2 seen_low(kInfinity);
    glm::vec2 seen_high(-kInfinity);
    for (const Vec3& p : surface.positions) {
        const glm::vec4 q = camera.view_from_world * glm::vec4(p, 1.0f);
        const glm::vec2 seen = glm::vec2(q) / -q.z;
        seen_low = glm::min(seen_low, seen);
        seen_high = glm::max(seen_high, seen);
    }
    const float aspect = static_cast<float>(width_px) / static_cast<float>(height_px);
    const glm::vec2 size = (seen_high - seen_low) / (1.0f - 2.0f * kMargin);
    const float height = std::max({size.y, size.x / aspect, 1e-6f});
    const glm::vec2 half = 0.5f * height * glm::vec2(aspect, 1.0f);
    const glm::vec2 at = 0.5f * (seen_low + seen_high);
    camera.window = {at.x - half.x, at.x + half.x, at.y - half.y, at.y + half.y};
    return camera;
}

}  // namespace zskel
