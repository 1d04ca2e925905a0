// The CPU's Z-buffer, by each instruction set that this machine has, against closed forms and rays.
#include "zskel/visibility/cpu_source.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/models.h"
#include "support/records.h"
#include "support/shapes.h"
#include "zskel/compare.h"
#include "zskel/core/instruction_set.h"
#include "zskel/core/parallel.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/ray_source.h"
#include "zskel/visibility/surface_query.h"
#include "zskel/visibility/triangle_clusters.h"

using namespace zskel;

namespace {

// Runs `body` once with each instruction set.
void for_each_instruction_set(const std::function<void()>& body) {
    for (const std::int64_t target : usable_instruction_sets()) {
        CAPTURE(hwy::TargetName(target));
        force_instruction_set(target);
        CHECK(cpu_instruction_set() == hwy::TargetName(target));
        body();
    }
    force_instruction_set(0);
}

MapBatch render(VisibilitySource& source, std::span<const Vec3> eyes) {
    MapBatch maps;
    source.render(eyes, maps);
    return maps;
}

Mesh nested() {
    return test::together(test::sphere(0.5, 2), test::moved(test::sphere(0.2, 2), {0.1, 0, 0}));
}

Mesh plate() {
    Mesh mesh = test::cylinder(0.3, 1.0, 24, 9);
    for (DVec3& p : mesh.positions) p.x *= 0.02;
    return mesh;
}

}  // namespace

TEST_CASE("cpu: a wall's distance is exact at every texel, whatever the size of the map") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const std::vector<Vec3> eyes{{0.125f, -0.25f, 0.0625f}, {0.49f, 0.49f, 0.49f}, {0, 0, 0}};
    for_each_instruction_set([&] {
        for (const int face_px : {4, 7, 16, 33}) {
            CAPTURE(face_px);
            const auto source = make_cpu_source(prepared.surface, face_px);
            const MapBatch maps = render(*source, eyes);
            double worst = 0.0;
            for (std::size_t e = 0; e < eyes.size(); ++e) {
                for (std::size_t i = 0; i < maps.directions; ++i) {
                    const DVec3& d = source->directions().unit[i];
                    double nearest = 1e9;
                    for (int k = 0; k < 3; ++k) {
                        if (d[k] != 0.0) {
                            nearest =
                                std::min(nearest, ((d[k] > 0 ? 0.5 : -0.5) - eyes[e][k]) / d[k]);
                        }
                    }
                    worst =
                        std::max(worst, test::relative(maps.view(e).distance[i], nearest, nearest));
                }
            }
            CHECK(worst < 1e-6);
        }
    });
}

TEST_CASE("cpu: against rays, texel by texel, on smooth, sharp, thin and nested solids") {
    BackendOptions cpu_options;
    cpu_options.kind = BackendKind::Cpu;
    BackendOptions ray_options;
    ray_options.kind = BackendKind::Ray;
    for_each_instruction_set([&] {
        for (const int face_px : {8, 16, 19}) {
            cpu_options.face_px = ray_options.face_px = face_px;
            const auto cpu = open_backend(cpu_options);
            const auto rays = open_backend(ray_options);
            for (const Mesh& mesh : {test::torus(), test::cube(), plate(), nested()}) {
                const SourceComparison c = compare_backends(mesh, *cpu, *rays, 12, {});
                CHECK(c.eyes >= 6);
                CHECK(is_within(c, ComparisonBounds{}));
                CHECK(c.one_sided == 0);
                CHECK(c.id_agreement_inner > 0.999);
            }
        }
    });
}

TEST_CASE("cpu: no texel shows through the seams of a closed surface") {
    const PreparedSurface prepared = prepare_surface(test::sphere(0.5, 5));
    std::vector<Vec3> eyes;
    for (int i = 0; i < 60; ++i) {
        const float t = 0.1f * static_cast<float>(i);
        eyes.emplace_back(0.05f * t * std::cos(5.0f * t), 0.05f * t * std::sin(5.0f * t),
                          0.04f * (t - 3.0f));
    }
    for_each_instruction_set([&] {
        const auto source = make_cpu_source(prepared.surface, 64);
        const MapBatch maps = render(*source, eyes);
        CHECK(std::none_of(maps.id.begin(), maps.id.end(),
                           [](std::uint32_t id) { return id == kNone; }));
    });
}

TEST_CASE("cpu: a record is what `summarize` makes of the eye's map") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const Vec3 inside = prepared.surface.world_from_model.to_world({0.33, 0.03, 0.02});
    const Vec3 outside = prepared.surface.world_from_model.to_world({0.1, 0.05, 0.3});
    for_each_instruction_set([&] {
        for (const int face_px : {4, 9, 16}) {
            const auto source = make_cpu_source(prepared.surface, face_px);
            for (const Vec3& eye : {inside, outside}) {
                const MapBatch maps = render(*source, std::span(&eye, 1));
                const EyeRecord expected =
                    summarize(source->directions(), maps.view(0), prepared.surface);
                CHECK(test::difference(test::look(*source, eye), expected) < 2e-6);
            }
            CHECK(test::look(*source, inside).back_fraction == doctest::Approx(1.0));
            CHECK(test::look(*source, outside).back_fraction < 0.01);
        }
    });
}

TEST_CASE("cpu: instruction sets agree") {
    const PreparedSurface prepared = test::model("horse");
    const auto source = make_cpu_source(prepared.surface, 16);
    const std::vector<Vec3> eyes = comparison_eyes(prepared.surface, *source, 60, {});
    std::vector<EyeRecord> first(eyes.size());
    source->look(eyes, first);
    for_each_instruction_set([&] {
        std::vector<EyeRecord> records(eyes.size());
        source->look(eyes, records);
        double worst = 0.0;
        for (std::size_t i = 0; i < eyes.size(); ++i)
            worst = std::max(worst, test::difference(records[i], first[i]));
        CHECK(worst < 1e-4);
    });
}

TEST_CASE("cpu: of a large solid eyes far from it see a level, eyes near it the surface itself") {
    Mesh mesh = test::sphere(0.5, 7);
    for (DVec3& p : mesh.positions) {
        p *= 1.0 + 0.05 * std::sin(23.0 * p.x) * std::sin(19.0 * p.y) * std::sin(29.0 * p.z);
        p.z *= 0.6;
    }
    const PreparedSurface prepared = prepare_surface(mesh);
    const Surface& surface = prepared.surface;
    REQUIRE(surface.triangles.size() > kLevelsFrom);
    const auto exact = make_cpu_source(surface, 10);
    const auto levels = make_cpu_source(surface, 10, CpuDetail::Levels);
    std::vector<Vec3> near;
    std::vector<Vec3> far;
    for (std::size_t v = 0; v < surface.positions.size(); v += 4001) {
        near.push_back(surface.positions[v] - surface.vertex_normals[v] * 1e-3f);
        far.push_back(surface.positions[v] * 0.8f);
    }
    for (const Vec3& eye : near)
        CHECK(test::difference(test::look(*levels, eye), test::look(*exact, eye)) == 0.0);
    std::size_t other = 0;
    for (const Vec3& eye : far)
        other += test::difference(test::look(*levels, eye), test::look(*exact, eye)) > 0.0 ? 1 : 0;
    CHECK(other == far.size());
    BackendInfo info;
    info.has_levels = true;
    const SourceComparison c = compare_sources(*levels, *exact, far);
    CHECK(is_within(c, bounds_of(info, surface.triangles.size())));
    CHECK(!is_within(c, bounds_of(info, kLevelsFrom - 1)));
    CHECK(c.all.worst == 0.0);  // whole maps are exact

    // A sheet that is thinner than a level's cells.
    for (DVec3& p : mesh.positions) p.z *= 0.004;
    const PreparedSurface sheet = prepare_surface(mesh);
    const auto sheet_exact = make_cpu_source(sheet.surface, 10);
    const auto sheet_levels = make_cpu_source(sheet.surface, 10, CpuDetail::Levels);
    for (const Vec3& eye : {Vec3(0.0f), Vec3(0.2f, -0.1f, 0.0f)}) {
        const EyeRecord record = test::look(*sheet_levels, eye);
        CHECK(record.back_fraction > 0.99f);
        CHECK(test::difference(record, test::look(*sheet_exact, eye)) == 0.0);
    }
}

TEST_CASE("cpu: whether a block is near is told by its box") {
    const PreparedSurface prepared = prepare_surface(test::sphere(0.5, 5));
    const TriangleClusters clusters = cluster_triangles(prepared.surface);
    const SurfaceQuery query(prepared.surface);
    for (const Vec3& p : {Vec3(0.0f), Vec3(0.3f, 0.1f, 0.0f), Vec3(0.1f, 0.3f, 0.1f)}) {
        const float distance = query.nearest(p).distance;
        CHECK(is_near(clusters, p, 1.001f * distance));
        CHECK(!is_near(clusters, p, distance - 0.1f));
    }
}

TEST_CASE("cpu: misses of an open mesh are +inf and counted") {
    Mesh open = test::cube();
    open.triangles.resize(open.triangles.size() - 2);  // without the wall at +x
    const PreparedSurface prepared = prepare_surface(open);
    for_each_instruction_set([&] {
        const auto source = make_cpu_source(prepared.surface, 16);
        const Vec3 eye(0.0f);
        const MapBatch maps = render(*source, std::span(&eye, 1));
        CHECK(std::all_of(maps.distance.begin(), maps.distance.begin() + 256,
                          [](float r) { return r == kInfinity; }));
        CHECK(std::all_of(maps.id.begin(), maps.id.begin() + 256,
                          [](std::uint32_t id) { return id == kNone; }));
        const EyeRecord record = test::look(*source, eye);
        CHECK(record.hit_fraction == doctest::Approx(5.0 / 6.0).epsilon(1e-6));
        CHECK(record.force.x > 0.0f);  // nothing repels from the open side
        CHECK(record.clearance == kInfinity);
        const EyeRecord far = test::look(*source, {5.0f, 0.0f, 0.0f});
        CHECK(far.hit_fraction < 0.1f);
        CHECK(far.hit_fraction > 0.0f);
    });
}

TEST_CASE("cpu: an eye in the plane of a wall, in a corner, and nearer than the near plane") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto source = make_cpu_source(prepared.surface, 15);
    for_each_instruction_set([&] {
        for (const Vec3& eye : {Vec3(0.5f, 0.0f, 0.0f), Vec3(0.5f), Vec3(0.5f, 0.5f, 3.0f),
                                Vec3(0.5f - 1e-7f, 0.2f, 0.1f)}) {
            const EyeRecord record = test::look(*source, eye);
            CHECK(std::isfinite(glm::length(record.force)));
            CHECK(std::all_of(record.jacobian.begin(), record.jacobian.end(),
                              [](float x) { return std::isfinite(x); }));
            CHECK(record.hit_fraction <= 1.0f + 1e-6f);
        }
    });
}

TEST_CASE("cpu: equal depths show the lowest triangle, in whatever order they are drawn") {
    // The first makes boxes of many texels, the second of one.
    for (const double size : {0.2, -0.2, 0.05, -0.05}) {
        Mesh mesh = test::sphere(0.5, 3);  // enough triangles for many clusters
        const auto lowest = static_cast<std::uint32_t>(mesh.triangles.size());
        const double half = std::abs(size);
        for (const double y : {0.0625 + 0.25 * size, 0.0625 - 0.25 * size}) {
            const auto n = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), {{0.25, y - half, 0.0625 - half},
                                                         {0.25, y + half, 0.0625 - half},
                                                         {0.25, y, 0.0625 + half}});
            test::add_triangle(mesh, n, n + 1, n + 2);
        }
        // Corners of one lie on a side of the other, and are to stay there.
        const PreparedSurface prepared =
            prepare_surface(mesh, WorldSize::UnitCube, {.weld_tolerance_diagonals = 0.0});
        const Surface& surface = prepared.surface;
        REQUIRE(surface.triangles.size() == lowest + 2);
        for_each_instruction_set([&] {
            const auto source = make_cpu_source(surface, 4);
            const Vec3 eye = surface.world_from_model.to_world(DVec3(0.0));
            const MapBatch maps = render(*source, std::span(&eye, 1));
            CHECK(maps.id[texel_index(texel_of_direction({1, 0.25, 0.25}, 4), 4)] == lowest);
        });
    }
}

TEST_CASE("cpu: records do not depend on the number of threads, nor on the batch") {
    const PreparedSurface prepared = test::model("octopus");
    const auto source = make_cpu_source(prepared.surface, 8);
    const std::vector<Vec3> eyes = comparison_eyes(prepared.surface, *source, 90, {});
    std::vector<EyeRecord> all(eyes.size());
    std::vector<EyeRecord> alone(eyes.size());
    source->look(eyes, all);
    set_thread_limit(1);
    source->look(eyes, alone);
    set_thread_limit(0);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        CHECK(test::difference(all[i], alone[i]) == 0.0);
        CHECK(test::difference(all[i], test::look(*source, eyes[i])) == 0.0);
    }
}
