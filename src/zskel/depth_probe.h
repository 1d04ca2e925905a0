#pragma once

#include <memory>
#include <string>
#include <vector>

#include "zskel/extract.h"
#include "zskel/io/depth_exr.h"
#include "zskel/mesh/solid.h"

namespace zskel {

/// Cube maps of chosen eyes of a model, for looking at and for dumps. Ids are faces of the input.
class DepthProbe {
  public:
    /// @throws InputError for a mesh without area. `mesh` and `backend` must outlive the probe; the
    /// backend must sample cube maps. @throws UsageError when it does not.
    DepthProbe(const Mesh& mesh, Backend& backend);
    ~DepthProbe();

    /// The map seen from a point in model space, in the solid that holds it (else the nearest one).
    /// @throws UsageError more than 1000 model sizes away.
    DepthDump at_point(const DVec3& eye_model);

    /// The maps along the path of the seed of an input vertex, start to rest: the very path that
    /// `extract_skeleton` finds with the same options and backend.
    /// @throws UsageError for a vertex that is not there or has no face.
    std::vector<DepthDump> along_path(std::uint32_t vertex, const ExtractOptions& options);

  private:
    struct Part;
    DepthDump dump(Part& part, const Vec3& eye_world, int step);

    const Mesh& mesh_;
    Backend& backend_;
    PreparedSurface prepared_;
    std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace zskel
