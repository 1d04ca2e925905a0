#pragma once

#include "zskel/extract.h"

namespace zskel::test {

/// The skeleton by rays, at a size that is quick.
inline ExtractResult extract(const Mesh& mesh, const ExtractOptions& options = {},
                             int face_px = 8) {
    BackendOptions backend_options;
    backend_options.kind = BackendKind::Ray;
    backend_options.face_px = face_px;
    return extract_skeleton(mesh, options, *open_backend(backend_options));
}

}  // namespace zskel::test
