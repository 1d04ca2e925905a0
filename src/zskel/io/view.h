#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "zskel/core/types.h"
#include "zskel/mesh/surface.h"

namespace zskel {

/// Where a picture is taken from: the camera's place on a sphere about the model. Azimuth 0 and
/// elevation 0 is the front (+z with y up, -y with z up); azimuth grows towards +x.
struct View {
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    bool is_z_up = false;
};

/// Reads `front`, `back`, `left`, `right`, `top`, `bottom`, `iso`, or `azimuth,elevation` in
/// degrees; y is up unless `,z` follows (`iso,z`, `30,20,z`). @throws UsageError.
View parse_view(std::string_view text);

/// A perspective camera fitted to a surface.
struct Camera {
    glm::mat4 view_from_world{1.0f};
    glm::vec4 window{0.0f};  ///< left, right, bottom, top of the picture on the plane at distance 1
    float distance = 0.0f;   ///< from the eye to the model's middle, world units
    float near_plane = 0.0f;

    /// Of the picture's rows from `bottom` to `top` (shares of its height), reversed depth.
    glm::mat4 clip_from_view(float bottom = 0.0f, float top = 1.0f) const;
    /// World units that a pixel covers at the model's middle.
    float world_per_px(int height_px) const {
        return (window.w - window.z) * distance / static_cast<float>(height_px);
    }
    /// Pixel (columns to the right, rows down) where a world point is seen.
    glm::vec2 pixel_of(const Vec3& world, int width_px, int height_px) const;
};

/// The camera that shows the whole surface with a margin. Without a view it looks along the axis in
/// which the surface spreads least, a little turned. Up is the axis on which the model stands if
/// its lowest points tell, else y.
Camera aim_camera(const Surface& surface, const std::optional<View>& view, int width_px,
                  int height_px);

}  // namespace zskel
