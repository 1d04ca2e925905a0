#pragma once

#include <vector>

#include "zskel/mesh/welded_mesh.h"

namespace zskel {

/// How much of what a group of triangles sees is nothing at all: the shares of rays, from places on
/// its front and on its back, that leave the model.
struct Outlook {
    double front = 0.0;
    double back = 0.0;
};

/// By rays in fixed directions from places spread over each group's area; a source is Takayama,
/// Jacobson, Kavan and Sorkine-Hornung, "A simple method for correcting facet orientations in
/// polygon meshes based on ray casting" (2014).
/// @param group   of every triangle, below `groups`; kNone: only in the way.
/// @throws std::bad_alloc.
std::vector<Outlook> look_out(const WeldedMesh& mesh, const std::vector<std::uint32_t>& group,
                              std::size_t groups);

}  // namespace zskel
