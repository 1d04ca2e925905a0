#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "zskel/core/types.h"
#include "zskel/mesh/surface.h"
#include "zskel/visibility/force.h"

namespace zskel {

/// One eye's cube map with all that is needed to use it again.
struct DepthDump {
    int face_px = 0;
    std::vector<float>
        distance;  ///< 6 face_px^2 radial distances in cube_map.h's order, world units
    std::vector<std::uint32_t> id;  ///< triangle of each texel; kNone where nothing was hit
    DVec3 eye_model{0.0};
    Vec3 eye_world{0.0f};
    int step = 0;             ///< steps taken from the seed; 0 at the start
    Force force;              ///< world space
    float near_plane = 0.0f;  ///< world units; 0 when rays found the distances
    Similarity world_from_model;
    std::string model;  ///< the file's path as given
    std::string backend;
    std::string version;  ///< of zskel

    MapView view() const { return {distance, id}; }
};

/// Writes an OpenEXR cube environment map (`envmap`, ENVMAP_CUBE), 32 bits, compressed without
/// loss: channels `Z` (depth_axial), `distance` (distance_radial) and `id` (uint), and one
/// attribute, named zskel..., for everything else in the dump. Faces lie as OpenEXR's
/// CubeMap::pixelPosition has them; texel centres do not: ours are at (i + 1/2) / n of a face,
/// OpenEXR's formula puts the outermost on the cube's edges.
/// @throws IoError naming the path.
void write_depth_exr(const std::string& path, const DepthDump& dump);

/// Reads a dump back, bit for bit. Strict: what write_depth_exr would not have written is refused.
/// @throws InputError naming the path and what is wrong.
DepthDump read_depth_exr(const std::string& path);

}  // namespace zskel
