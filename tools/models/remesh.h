#pragma once

#include "field.h"
#include "triangles.h"

#include <cstddef>

namespace zskel::models {

/// A mesh of about `target_faces` with the topology of `mesh`, its vertices spread evenly over the
/// field's surface.
Triangles remesh(const Triangles& mesh, const Field& field, std::size_t target_faces);

}  // namespace zskel::models
