#include "zskel/depth_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "zskel/visibility/raster_source.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {
namespace {

constexpr float kFarthestEye = 1000.0f;  // world units: model sizes

}  // namespace

// A solid, with what is prepared for it when it is first asked for.
struct DepthProbe::Part {
    explicit Part(Solid s) : solid(std::move(s)), query(solid.surface) {}

    Solid solid;
    SurfaceQuery query;
    std::unique_ptr<VisibilitySource> source;
};

DepthProbe::DepthProbe(const Mesh& mesh, Backend& backend)
    : mesh_(mesh), backend_(backend), prepared_(prepare_surface(mesh)) {
    for (Solid& solid : split_solids(prepared_))
        parts_.push_back(std::make_unique<Part>(std::move(solid)));
}

DepthProbe::~DepthProbe() = default;

DepthDump DepthProbe::at_point(const DVec3& eye_model) {
    const Vec3 eye = prepared_.surface.world_from_model.to_world(eye_model);
    // Far outside, distances lose all precision; the bound also refuses what is not finite.
    if (!(glm::length(eye) <= kFarthestEye)) {
        throw UsageError(fmt::format("an eye at {} {} {} is more than {} model sizes away",
                                     eye_model.x, eye_model.y, eye_model.z, kFarthestEye));
    }
    const auto holds = [&](const std::unique_ptr<Part>& part) {
        return part->query.winding_number(eye) > 0.5;
    };
    auto part = std::find_if(parts_.begin(), parts_.end(), holds);
    if (part == parts_.end()) {
        part = std::min_element(parts_.begin(), parts_.end(), [&](const auto& l, const auto& r) {
            return l->query.nearest(eye).distance < r->query.nearest(eye).distance;
        });
    }
    return dump(**part, eye, 0);
}

std::vector<DepthDump> DepthProbe::along_path(std::uint32_t vertex, const ExtractOptions& options) {
    if (vertex >= mesh_.positions.size()) {
        throw UsageError(fmt::format("{}: there is no vertex {}; the last is {}", mesh_.name,
                                     vertex, mesh_.positions.size() - 1));
    }
    const std::uint32_t place = prepared_.surface_vertex[vertex];
    if (place == kNone)
        throw UsageError(fmt::format("{}: vertex {} has no face, so no seed", mesh_.name, vertex));
    for (const auto& part : parts_) {
        const auto& owned = part->solid.vertex;
        const auto at = std::find(owned.begin(), owned.end(), place);
        if (at == owned.end()) continue;
        if (!part->source) part->source = backend_.prepare(part->solid.surface);
        const auto local = static_cast<std::size_t>(at - owned.begin());
        const Seed seed = place_seeds(part->solid.surface, part->query, options.paper.seeds)[local];
        PaperStepOptions steps = options.paper.steps;
        steps.keep_paths = true;
        const SettledSeed settled = settle_seeds(*part->source, std::span(&seed, 1), steps).front();
        std::vector<DepthDump> dumps;
        for (const Vec3& p : settled.path)
            dumps.push_back(dump(*part, p, static_cast<int>(dumps.size())));
        if (dumps.empty()) dumps.push_back(dump(*part, seed.position, 0));
        return dumps;
    }
    throw Error(ExitCode::Internal,
                fmt::format("{}: vertex {} is in no solid", mesh_.name, vertex));
}

DepthDump DepthProbe::dump(Part& part, const Vec3& eye_world, int step) {
    if (!part.source) part.source = backend_.prepare(part.solid.surface);
    const Directions& directions = part.source->directions();
    if (directions.face_px == 0) throw UsageError("a depth map needs a cube map: leave --rays out");
    MapBatch maps;
    part.source->render(std::span(&eye_world, 1), maps);
    DepthDump out;
    out.face_px = directions.face_px;
    out.force = force_at(directions, maps.view(0));
    out.distance = std::move(maps.distance);
    out.id = std::move(maps.id);
    for (std::uint32_t& id : out.id) {
        if (id != kNone)
            id = mesh_.face_of_triangle[prepared_.input_triangle[part.solid.triangle[id]]];
    }
    out.world_from_model = prepared_.surface.world_from_model;
    out.eye_world = eye_world;
    out.eye_model = out.world_from_model.to_model(eye_world);
    out.step = step;
    out.near_plane = backend_.info().is_raster ? kNearPlane : 0.0f;
    out.model = mesh_.name;
    out.backend = backend_.info().name;
    out.version = ZSKEL_VERSION;
    return out;
}

}  // namespace zskel
