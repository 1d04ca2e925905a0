#include "model.h"

#include "extract_surface.h"
#include "field.h"
#include "remesh.h"

#include <utility>

namespace zskel::models {

Model mesh_shape(const std::string& name, Shape shape, const Expected& expected, int levels) {
    shape.fit_unit_cube();
    const Field field(shape);
    Triangles mesh = remesh(extract_surface(field, levels), field, expected.faces);
    return {name, std::move(mesh), shape.truth(), expected};
}

}  // namespace zskel::models
