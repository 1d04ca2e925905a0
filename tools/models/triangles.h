#pragma once

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace zskel::models {

/// A triangle mesh with shared vertices; faces turn counter-clockwise seen from outside.
struct Triangles {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> faces;
};

/// Moves the mesh's vertices to a grid of `step`, the precision that the files keep.
void round_vertices(Triangles& mesh, double step);

/// Distance from `p` to the nearest point of the mesh, by looking at every triangle.
double distance_to_mesh(const Triangles& mesh, const glm::dvec3& p);

/// How often the mesh winds around `p`: 1 inside a closed outward mesh, 0 outside.
double winding_number(const Triangles& mesh, const glm::dvec3& p);

}  // namespace zskel::models
