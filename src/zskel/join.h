#pragma once

#include <cstdint>
#include <vector>

#include "zskel/mesh/mesh.h"
#include "zskel/mesh/surface.h"

namespace zskel {

struct JoinOptions {
    double voxel_model = 0.0;  ///< side of the cubes it is sampled in; 0: the longest side / 160
};

/// What several parts bound together.
struct JoinedMesh {
    Mesh mesh;  ///< closed, manifold, outward
    std::vector<std::uint32_t>
        nearest;  ///< of every input vertex: a vertex of `mesh`; kNone when unused
    std::vector<Repair>
        repairs;               ///< of the parts, that they were joined, and what of them was lost
    double voxel_model = 0.0;  ///< what is about as small means nothing
};

/// Unites parts that overlap or touch: inside is where the winding number of all of them, each
/// oriented outward and its openings capped, is above one half; cavities are filled. Meshed
/// from samples of the distance, so that details below a voxel are lost: voids between parts that
/// are thinner than two voxels are filled, and vertices that end up outside are counted, as
/// repairs.
/// @throws InputError when nothing has an inside; UsageError for a voxel that is too small.
JoinedMesh join_parts(const Mesh& mesh, const RepairOptions& repair, const JoinOptions& options);

}  // namespace zskel
