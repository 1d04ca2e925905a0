#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/records.h"
#include "support/shapes.h"
#include "zskel/compare.h"
#include "zskel/visibility/backend.h"
#include "zskel/visibility/cube_map.h"

using namespace zskel;

namespace {

std::unique_ptr<Backend> backend_of(BackendKind kind, int face_px = 16) {
    BackendOptions options;
    options.kind = kind;
    options.exact = true;
    options.face_px = face_px;
    return open_backend(options);
}

bool has_osmesa() {
    try {
        backend_of(BackendKind::Osmesa);
        return true;
    } catch (const GlError&) {
        return false;
    }
}

}  // namespace

TEST_CASE("raster: a wall's distance is exact at every texel") {
    const PreparedSurface prepared = prepare_surface(test::cube());
    const auto backend = backend_of(BackendKind::Gl);
    const auto source = backend->prepare(prepared.surface);
    const std::vector<Vec3> eyes{{0.125f, -0.25f, 0.0625f}, {0.49f, 0.49f, 0.49f}, {0, 0, 0}};
    MapBatch maps;
    source->render(eyes, maps);
    // Hardware may show the next wall where a texel lies on an edge to 1/256 of its size.
    const double tolerance = backend->info().name == "egl-hardware" ? 1.0 / 256.0 : 1e-5;
    for (std::size_t e = 0; e < eyes.size(); ++e) {
        const MapView map = maps.view(e);
        for (std::size_t i = 0; i < maps.directions; ++i) {
            const DVec3& d = source->directions().unit[i];
            double nearest = 1e9;
            for (int k = 0; k < 3; ++k) {
                if (d[k] != 0.0)
                    nearest = std::min(nearest, ((d[k] > 0 ? 0.5 : -0.5) - eyes[e][k]) / d[k]);
            }
            CHECK(map.distance[i] == doctest::Approx(nearest).epsilon(tolerance));
        }
    }
}

TEST_CASE("raster: the triangle that a texel names is the one its direction hits") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto backend = backend_of(BackendKind::Gl);
    const auto source = backend->prepare(prepared.surface);
    const Vec3 eye = prepared.surface.world_from_model.to_world({0.33, 0.03, 0.02});
    MapBatch maps;
    source->render(std::span(&eye, 1), maps);
    for (std::size_t i = 0; i < maps.directions; ++i) {
        REQUIRE(maps.id[i] < prepared.surface.triangles.size());
        const Triangle& t = prepared.surface.triangles[maps.id[i]];
        const DVec3 hit =
            DVec3(eye) + source->directions().unit[i] * static_cast<double>(maps.distance[i]);
        const DVec3 normal(prepared.surface.triangle_normals[maps.id[i]]);
        CHECK(std::abs(glm::dot(hit - DVec3(prepared.surface.positions[t.x]), normal)) < 1e-5);
    }
}

TEST_CASE("raster: a large batch holds what single eyes hold, eye by eye") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto backend = backend_of(BackendKind::Gl, 8);
    const auto source = backend->prepare(prepared.surface);
    std::vector<Vec3> eyes;
    for (int i = 0; i < 700; ++i) {  // several passes: a pass takes 256 eyes at most
        const double a = 0.01 * i;
        eyes.push_back(prepared.surface.world_from_model.to_world(
            {0.35 * std::cos(a), 0.35 * std::sin(a), 0.0}));
    }
    MapBatch all;
    source->render(eyes, all);
    for (const std::size_t e : {0u, 255u, 256u, 699u}) {
        MapBatch single;
        source->render(std::span(&eyes[e], 1), single);
        CHECK(std::equal(single.distance.begin(), single.distance.end(),
                         all.view(e).distance.begin()));
        CHECK(std::equal(single.id.begin(), single.id.end(), all.view(e).id.begin()));
    }
}

TEST_CASE("raster: misses of an open mesh are +inf and counted") {
    Mesh open = test::cube();
    open.triangles.resize(open.triangles.size() - 2);  // without the wall at +x
    const PreparedSurface prepared = prepare_surface(open);
    const auto backend = backend_of(BackendKind::Gl);
    const auto source = backend->prepare(prepared.surface);
    const Vec3 eye(0.0f);
    MapBatch maps;
    source->render(std::span(&eye, 1), maps);
    const Force force = force_at(source->directions(), maps.view(0));
    CHECK(force.hit_fraction == doctest::Approx(5.0 / 6.0).epsilon(1e-6));
    CHECK(force.vector.x > 0.0);  // nothing repels from the open side
    for (std::size_t i = 0; i < 256; ++i) {
        CHECK(maps.distance[i] == kInfinity);
        CHECK(maps.id[i] == kNone);
    }
}

TEST_CASE("raster: equal depths show the lowest triangle") {
    // Two coincident squares that share no vertex, so that neither is dropped as a duplicate face.
    Mesh mesh = test::cube();
    for (const double turn : {0.0, 1.0}) {
        const auto n = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(
            mesh.positions.end(),
            {{0.25, -0.4 - turn, -0.4}, {0.25, 0.4 + turn, -0.4}, {0.25, 0.0, 0.4 + turn}});
        test::add_triangle(mesh, n, n + 1, n + 2);
    }
    for (DVec3& p : mesh.positions) p = glm::clamp(p, -0.5, 0.5);
    const PreparedSurface prepared = prepare_surface(mesh);
    const auto backend = backend_of(BackendKind::Gl);
    const auto source = backend->prepare(prepared.surface);
    const Vec3 eye(0.0f, 0.0f, -0.3f);
    MapBatch maps;
    source->render(std::span(&eye, 1), maps);
    const std::size_t ahead = texel_index(texel_of_direction({1, 0.01, 0.01}, 16), 16);
    CHECK(maps.id[ahead] == 12);
}

TEST_CASE("record shader: a record is the CPU's, whatever the size of the map") {
    Mesh open = test::cube();
    open.triangles.resize(open.triangles.size() - 2);
    const Mesh nested =
        test::together(test::sphere(0.5, 2), test::moved(test::sphere(0.2, 2), {0.1, 0, 0}));
    for (const BackendKind kind : {BackendKind::Gl, BackendKind::Osmesa}) {
        if (kind == BackendKind::Osmesa && !has_osmesa()) continue;
        for (const int face_px : {4, 7, 8, 16}) {
            const auto backend = backend_of(kind, face_px);
            for (const Mesh& mesh : {test::torus(), open, nested, test::sphere(0.5, 5)}) {
                const PreparedSurface prepared = prepare_surface(test::askew(mesh));
                const auto source = backend->prepare(prepared.surface);
                std::vector<Vec3> eyes;
                for (int i = 0; i < 40; ++i) {  // some lie outside
                    const double a = 0.37 * i;
                    eyes.push_back(prepared.surface.world_from_model.to_world(
                        {0.35 * std::cos(a), 0.35 * std::sin(a), 0.004 * i}));
                }
                std::vector<EyeRecord> records(eyes.size());
                std::vector<EyeRecord> expected(eyes.size());
                source->look(eyes, records);
                backend_of(BackendKind::Cpu, face_px)
                    ->prepare(prepared.surface)
                    ->look(eyes, expected);
                double worst = 0.0;
                for (std::size_t e = 0; e < eyes.size(); ++e)
                    worst = std::max(worst, test::difference(records[e], expected[e]));
                CAPTURE(face_px);
                CHECK(worst < 1e-4);
            }
        }
    }
}

TEST_CASE("record shader: right where a software driver ends its loops too soon") {
    const PreparedSurface prepared = prepare_surface(test::askew(test::sphere(0.5, 7)));
    const auto gl_backend = backend_of(BackendKind::Gl);
    const auto cpu_backend = backend_of(BackendKind::Cpu);
    const auto source = gl_backend->prepare(prepared.surface);
    const auto cpu = cpu_backend->prepare(prepared.surface);
    for (const DVec3& p : {DVec3(0.2, 0.0, 0.1), DVec3(0.1, 0.2, 0.3)}) {
        const Vec3 eye = prepared.surface.world_from_model.to_world(p);
        const EyeRecord record = test::look(*source, eye);
        CHECK(record.hit_fraction == doctest::Approx(1.0));
        CHECK(test::difference(record, test::look(*cpu, eye)) < 2e-3);
    }
}

TEST_CASE("Backend: several solids' eyes at once give what each gives by itself") {
    const std::vector<Mesh> meshes{test::torus(), test::cube(), test::sphere(0.5, 4)};
    std::vector<PreparedSurface> prepared;
    for (const Mesh& mesh : meshes) prepared.push_back(prepare_surface(test::askew(mesh)));
    for (const int face_px : {8, 32}) {  // by the record shader, and by whole maps
        const auto backend = backend_of(BackendKind::Gl, face_px);
        std::vector<std::unique_ptr<VisibilitySource>> sources;
        std::vector<std::vector<Vec3>> eyes;
        std::vector<std::vector<EyeRecord>> records;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            sources.push_back(backend->prepare(prepared[i].surface));
            eyes.emplace_back();
            for (std::size_t e = 0; e < 3 + 2 * i; ++e)
                eyes[i].emplace_back(0.04f * static_cast<float>(e), 0.3f, 0.01f);
            records.emplace_back(eyes[i].size());
        }
        // The first has two turns, and one that wants nothing is between them.
        std::vector<EyeRecord> again(eyes[0].size());
        std::vector<Look> looks{{sources[0].get(), eyes[0], records[0]},
                                {sources[1].get(), {}, {}},
                                {sources[2].get(), eyes[2], records[2]},
                                {sources[1].get(), eyes[1], records[1]},
                                {sources[0].get(), eyes[0], again}};
        backend->look(looks);
        backend->look({});
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            std::vector<EyeRecord> alone(eyes[i].size());
            sources[i]->look(eyes[i], alone);
            for (std::size_t e = 0; e < alone.size(); ++e) {
                CHECK(alone[e].hit_fraction > 0.0f);
                CHECK(test::difference(records[i][e], alone[e]) == 0.0);
            }
        }
        for (std::size_t e = 0; e < again.size(); ++e)
            CHECK(test::difference(again[e], records[0][e]) == 0.0);
    }
}

TEST_CASE("record shader: maps too large for shared memory are reduced here") {
    const PreparedSurface prepared = prepare_surface(test::torus());
    const auto backend = backend_of(BackendKind::Gl, 32);
    const auto source = backend->prepare(prepared.surface);
    const Vec3 eye = prepared.surface.world_from_model.to_world({0.33, 0.03, 0.02});
    EyeRecord expected;
    source->VisibilitySource::look(std::span(&eye, 1), std::span(&expected, 1));
    CHECK(test::difference(test::look(*source, eye), expected) == 0.0);
}

TEST_CASE("raster against rays: within bounds on smooth, sharp, thin and nested solids") {
    const auto raster = backend_of(BackendKind::Gl);
    const auto rays = backend_of(BackendKind::Ray);
    Mesh plate = test::cylinder(0.3, 1.0, 24, 9);
    for (DVec3& p : plate.positions) p.x *= 0.02;
    const Mesh nested =
        test::together(test::sphere(0.5, 2), test::moved(test::sphere(0.2, 2), {0.1, 0, 0}));
    for (const Mesh& mesh : {test::torus(), test::cube(), plate, nested}) {
        const SourceComparison c = compare_backends(mesh, *raster, *rays, 12, {});
        CHECK(c.eyes >= 6);
        CHECK(c.one_sided == 0);
        CHECK(is_within(c, bounds_of(raster->info(), mesh.triangles.size())));
    }
}

TEST_CASE("raster: EGL and OSMesa agree with each other") {
    if (!has_osmesa()) {
        MESSAGE("no OSMesa here");
        return;
    }
    const auto egl = backend_of(BackendKind::Egl);
    const auto osmesa = backend_of(BackendKind::Osmesa);
    const SourceComparison c = compare_backends(test::torus(), *egl, *osmesa, 12, {});
    CHECK(is_within(c, {}));
    CHECK(c.id_agreement_inner == 1.0);
}

TEST_CASE("paper's method, raster against rays: seeds, nodes and skeletons agree") {
    const Mesh mesh = test::torus(0.35, 0.12, 24, 12);
    ExtractOptions options;
    options.method = Method::Paper;
    const ExtractResult a = extract_skeleton(mesh, options, *backend_of(BackendKind::Gl));
    const ExtractResult b = extract_skeleton(mesh, options, *backend_of(BackendKind::Ray));
    REQUIRE(a.seeds.size() == b.seeds.size());
    const double two_steps =
        2.0 * ExtractOptions{}.paper.steps.step_world / a.surface.world_from_model.scale;
    const auto near = std::count_if(a.seeds.begin(), a.seeds.end(), [&](const SeedReport& seed) {
        return glm::distance(seed.end,
                             b.seeds[static_cast<std::size_t>(&seed - a.seeds.data())].end) <=
               two_steps;
    });
    CHECK(static_cast<double>(near) >= 0.95 * static_cast<double>(a.seeds.size()));
    const auto nodes_a = static_cast<double>(a.graph.nodes.size());
    const auto nodes_b = static_cast<double>(b.graph.nodes.size());
    CHECK(std::abs(nodes_a - nodes_b) <= 0.1 * nodes_b);
}
