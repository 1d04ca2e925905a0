#include "scoring/subject.h"

#include <algorithm>

#include "zskel/mesh/check.h"

namespace zskel::scoring {
namespace {

// Longer than anything in a model of diagonal 1.
constexpr double kReach = 2.0;

double diagonal_of(const std::vector<Vec3>& positions) {
    DVec3 low(kInfinity);
    DVec3 high(-kInfinity);
    for (const Vec3& p : positions) {
        low = glm::min(low, DVec3(p));
        high = glm::max(high, DVec3(p));
    }
    return glm::distance(low, high);
}

void append(Surface& whole, const Surface& part) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    for (const Triangle& t : part.triangles) whole.triangles.push_back(t + first);
}

Surface surface_in_diagonals(const std::vector<Solid>& solids) {
    Surface whole;
    whole.world_from_model = solids.front().surface.world_from_model;
    for (const Solid& solid : solids) append(whole, solid.surface);
    const double scale = 1.0 / diagonal_of(whole.positions);
    for (Vec3& p : whole.positions) p = Vec3(DVec3(p) * scale);
    whole.world_from_model.scale *= scale;
    derive_normals(whole);
    derive_edges(whole);
    return whole;
}

}  // namespace

Subject::Subject(const Mesh& mesh) : Subject(mesh, split_solids(prepare_surface(mesh))) {}

Subject::Subject(const Mesh& mesh, const std::vector<Solid>& solids)
    : surface_(surface_in_diagonals(solids)),
      query_(surface_),
      expected_components_(solids.size()),
      is_closed_(std::all_of(solids.begin(), solids.end(),
                             [](const Solid& solid) { return solid.is_closed; })) {
    const MeshReport report = check_mesh(mesh);
    if (report.genus) expected_cycles_ = static_cast<std::size_t>(*report.genus);
}

bool Subject::is_inside(const DVec3& point) const {
    return query_.winding_number(Vec3(point)) > 0.5;
}

bool Subject::is_free(const DVec3& from, const DVec3& to) const {
    return !query_.first_hit(Vec3(from), Vec3(to));
}

double Subject::distance_at(const DVec3& point) const {
    return query_.nearest(Vec3(point)).distance;
}

std::optional<double> Subject::ray(const DVec3& from, const DVec3& direction) const {
    const auto hit = query_.first_hit(Vec3(from), Vec3(from + direction * kReach));
    if (!hit) return std::nullopt;
    return hit->fraction * kReach;
}

SkeletonGraph Subject::in_diagonals(const SkeletonGraph& graph) const {
    const Similarity& world = surface_.world_from_model;
    SkeletonGraph out = graph;
    for (SkeletonGraph::Node& node : out.nodes) {
        node.position = (node.position - world.center) * world.scale;
        node.radius *= world.scale;
    }
    return out;
}

}  // namespace zskel::scoring
