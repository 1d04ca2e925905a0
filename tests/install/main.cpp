// A mesh from arrays in memory, its skeleton, and the counts.
#include <zskel/extract.h>

#include <cstdio>
#include <cstring>

int main() {
    const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const unsigned corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    zskel::Mesh mesh;
    mesh.name = "tetrahedron";
    mesh.positions.resize(4);
    mesh.triangles.resize(4);
    std::memcpy(mesh.positions.data(), xyz, sizeof xyz);
    std::memcpy(mesh.triangles.data(), corners, sizeof corners);

    zskel::BackendOptions rays;
    rays.kind = zskel::BackendKind::Ray;
    const auto backend = zskel::open_backend(rays);
    const zskel::ExtractResult result = zskel::extract_skeleton(mesh, {}, *backend);
    std::printf("%zu vertices, %zu nodes, %zu edges\n", result.graph.vertex_node.size(),
                result.graph.nodes.size(), result.graph.edges.size());
    return result.graph.nodes.empty() ? 1 : 0;
}
