#include "zskel/io/depth_exr.h"

#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <doctest/doctest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include "support/box.h"
#include "zskel/core/error.h"
#include "zskel/visibility/cube_map.h"
#include "zskel/visibility/raster_source.h"
#include "zskel/visibility/ray_source.h"

using namespace zskel;

namespace {

constexpr int kFacePx = 16;

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)).string();
}

std::string bytes_of(const std::string& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return all.str();
}

void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// A map with hits and misses: an eye off the middle of a box whose top is open.
DepthDump make_dump() {
    Mesh mesh = test::make_box({10, 20, 30}, {12, 23, 34});
    PreparedSurface prepared = prepare_surface(mesh);
    Surface open = prepared.surface;
    open.triangles.pop_back();
    DepthDump dump;
    dump.face_px = kFacePx;
    dump.eye_model = {10.7, 21.1, 32.3};
    dump.world_from_model = open.world_from_model;
    dump.eye_world = open.world_from_model.to_world(dump.eye_model);
    const auto source = make_ray_source(open, cube_directions(kFacePx));
    MapBatch batch;
    source->render({&dump.eye_world, 1}, batch);
    dump.distance = batch.distance;
    dump.id = batch.id;
    dump.force = force_at(source->directions(), batch.view(0));
    dump.step = 3;
    dump.near_plane = kNearPlane;
    dump.model = "a box, open at the top";
    dump.backend = "ray";
    dump.version = "0.0.0-test";
    return dump;
}

// The file's channel as OpenEXR itself reads it, rows downward.
template <typename T>
std::vector<T> channel(const std::string& path, const char* name, Imf::PixelType type) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const int width = window.max.x + 1;
    const int height = window.max.y + 1;
    std::vector<T> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    Imf::FrameBuffer frame;
    frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values.data()), sizeof(T),
                                  sizeof(T) * static_cast<std::size_t>(width)));
    file.setFrameBuffer(frame);
    file.readPixels(0, height - 1);
    return values;
}

// Writes the dump with its header and pixels changed by `change`.
void write_changed(const std::string& path, const std::string& out,
                   const std::function<void(Imf::Header&, std::vector<float>&)>& change) {
    std::vector<float> depth = channel<float>(path, "Z", Imf::FLOAT);
    std::vector<float> distance = channel<float>(path, "distance", Imf::FLOAT);
    std::vector<unsigned> id = channel<unsigned>(path, "id", Imf::UINT);
    Imf::Header header = Imf::InputFile(path.c_str()).header();
    change(header, distance);
    Imf::OutputFile file(out.c_str(), header);
    Imf::FrameBuffer frame;
    const auto row = sizeof(float) * static_cast<std::size_t>(kFacePx);
    frame.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depth.data()), 4, row));
    frame.insert("distance",
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(distance.data()), 4, row));
    frame.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(id.data()), 4, row));
    file.setFrameBuffer(frame);
    file.writePixels(6 * kFacePx);
}

bool same_bits(const DVec3& a, const DVec3& b) {
    for (int i = 0; i < 3; ++i) {
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("write_depth_exr: what is read back gives the same force bit for bit") {
    const DepthDump dump = make_dump();
    const std::string path = temporary("_back.exr");
    write_depth_exr(path, dump);
    const DepthDump back = read_depth_exr(path);
    CHECK(back.face_px == dump.face_px);
    CHECK(back.distance == dump.distance);  // no NaN in it, and +inf equals itself
    CHECK(back.id == dump.id);
    const Force force = force_at(cube_directions(back.face_px), back.view());
    CHECK(same_bits(force.vector, dump.force.vector));
    CHECK(same_bits(back.force.vector, dump.force.vector));
    CHECK(back.force.mean_inverse_distance == dump.force.mean_inverse_distance);
    CHECK(back.force.hit_fraction == dump.force.hit_fraction);
    CHECK(dump.force.hit_fraction < 1.0);
    CHECK(same_bits(back.eye_model, dump.eye_model));
    CHECK(back.eye_world == dump.eye_world);
    CHECK(back.step == 3);
    CHECK(back.near_plane == kNearPlane);
    CHECK(same_bits(back.world_from_model.center, dump.world_from_model.center));
    CHECK(back.world_from_model.scale == dump.world_from_model.scale);
    CHECK(back.model == dump.model);
    CHECK(back.backend == "ray");
    CHECK(back.version == "0.0.0-test");
    const std::string bytes = bytes_of(path);
    write_depth_exr(path, dump);
    CHECK(bytes_of(path) == bytes);
    std::filesystem::remove(path);
}

TEST_CASE("write_depth_exr: a known point is in the face and quadrant that OpenEXR gives") {
    const std::string path = temporary("_place.exr");
    const Imath::Box2i window({0, 0}, {kFacePx - 1, 6 * kFacePx - 1});
    const DVec3 corner_signs[] = {{1, 1, 1}, {1, -1, 1}, {-1, 1, 1}, {-1, -1, 1}};
    const DVec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const DVec3& axis : axes) {
        for (const DVec3& signs : corner_signs) {
            const DVec3 side(axis.y + axis.z, axis.z + axis.x, axis.x + axis.y);
            const DVec3 direction =
                axis + signs.x * 0.6 * glm::abs(side) + signs.y * 0.35 * glm::cross(axis, side);
            DepthDump dump = make_dump();
            const std::size_t texel = texel_index(texel_of_direction(direction, kFacePx), kFacePx);
            dump.distance[texel] = 7.25f;
            dump.id[texel] = 4'000'000'001u;
            write_depth_exr(path, dump);

            Imf::CubeMapFace face{};
            Imath::V2f in_face;
            Imf::CubeMap::faceAndPixelPosition(
                Imath::V3f(Imath::V3d(direction.x, direction.y, direction.z)), window, face,
                in_face);
            const Imath::Box2i face_window = Imf::CubeMap::dataWindowForFace(face, window);
            const Imath::V2f expected = Imf::CubeMap::pixelPosition(face, window, in_face);
            const std::vector<unsigned> ids = channel<unsigned>(path, "id", Imf::UINT);
            const auto found =
                static_cast<int>(std::find(ids.begin(), ids.end(), 4'000'000'001u) - ids.begin());
            const Imath::V2i pixel(found % kFacePx, found / kFacePx);
            CAPTURE(direction.x);
            CAPTURE(direction.y);
            CAPTURE(direction.z);
            CHECK(face_window.intersects(pixel));
            CHECK(std::abs(static_cast<float>(pixel.x) - expected.x) <=
                  1.0f);  // half a texel, and rounding
            CHECK(std::abs(static_cast<float>(pixel.y) - expected.y) <= 1.0f);
            const double middle = (kFacePx - 1) * 0.5;
            const int local_y = pixel.y - face_window.min.y;
            CHECK((pixel.x > middle) == (static_cast<double>(expected.x) > middle));
            CHECK((local_y > middle) ==
                  (static_cast<double>(expected.y) - face_window.min.y > middle));
        }
    }
    std::filesystem::remove(path);
}

TEST_CASE(
    "write_depth_exr: every texel lies where OpenEXR's direction for its pixel points, half a "
    "texel off at most") {
    for (const int face_px : {4, 5, 16}) {
        DepthDump dump;
        dump.face_px = face_px;
        const std::size_t texels =
            6 * static_cast<std::size_t>(face_px) * static_cast<std::size_t>(face_px);
        dump.distance.assign(texels, 1.0f);
        for (std::uint32_t i = 0; i < texels; ++i) dump.id.push_back(i);
        const std::string path = temporary("_all.exr");
        write_depth_exr(path, dump);
        const Imath::Box2i window({0, 0}, {face_px - 1, 6 * face_px - 1});
        const std::vector<unsigned> ids = channel<unsigned>(path, "id", Imf::UINT);
        const double half_texel = 1.0 / face_px + 1e-6;
        for (int face = 0; face < 6; ++face) {
            for (int y = 0; y < face_px; ++y) {
                for (int x = 0; x < face_px; ++x) {
                    const auto which = static_cast<Imf::CubeMapFace>(face);
                    const Imath::V2f in_face(static_cast<float>(x), static_cast<float>(y));
                    const Imath::V2f at = Imf::CubeMap::pixelPosition(which, window, in_face);
                    Imath::V3f theirs = Imf::CubeMap::direction(which, window, in_face);
                    theirs /=
                        std::max({std::abs(theirs.x), std::abs(theirs.y), std::abs(theirs.z)});
                    const auto pixel =
                        static_cast<std::size_t>(std::lround(at.y) * face_px + std::lround(at.x));
                    const DVec3 ours = texel_direction(texel_at(ids[pixel], face_px), face_px);
                    const DVec3 gap = glm::abs(ours - DVec3(theirs.x, theirs.y, theirs.z));
                    CHECK(std::max({gap.x, gap.y, gap.z}) <= half_texel);
                }
            }
        }
        std::filesystem::remove(path);
    }
}

TEST_CASE("write_depth_exr: Z is the distance along the face's axis") {
    const DepthDump dump = make_dump();
    const std::string path = temporary("_z.exr");
    write_depth_exr(path, dump);
    const std::vector<float> depth = channel<float>(path, "Z", Imf::FLOAT);
    const std::vector<float> distance = channel<float>(path, "distance", Imf::FLOAT);
    const std::vector<unsigned> id = channel<unsigned>(path, "id", Imf::UINT);
    // On the face that looks at a wall of the box (-X, the second), every hit has the wall's
    // distance.
    const auto wall = static_cast<float>((10.7 - 10.0) * dump.world_from_model.scale);
    for (std::size_t i = kFacePx * kFacePx; i < 2 * kFacePx * kFacePx; ++i) {
        if (distance[i] > wall * 1.2f) continue;  // past the wall's rim
        CHECK(depth[i] == doctest::Approx(wall).epsilon(1e-5));
    }
    std::size_t misses = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        CHECK(std::isinf(depth[i]) == (id[i] == kNone));
        misses += std::isinf(depth[i]) ? 1 : 0;
    }
    CHECK(misses > 0);
    std::filesystem::remove(path);
}

// Header::erase of OpenEXR 3.1 leaks the attribute.
static void leave_out(Imf::Header& header, std::string_view name) {
    Imf::Header kept;
    for (auto at = header.begin(); at != header.end(); ++at) {
        if (at.name() != name) kept.insert(at.name(), at.attribute());
    }
    header = kept;
}

TEST_CASE("read_depth_exr: what write_depth_exr would not have written is refused") {
    const std::string path = temporary("_good.exr");
    const std::string bad = temporary("_bad.exr");
    write_depth_exr(path, make_dump());
    write_changed(path, bad, [](Imf::Header&, std::vector<float>&) {});
    CHECK_NOTHROW(read_depth_exr(bad));
    const std::function<void(Imf::Header&, std::vector<float>&)> changes[] = {
        [](Imf::Header& header, std::vector<float>&) { leave_out(header, "envmap"); },
        [](Imf::Header& header, std::vector<float>&) {
            Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
        },
        [](Imf::Header& header, std::vector<float>&) { leave_out(header, "zskelEyeModel"); },
        [](Imf::Header& header, std::vector<float>&) { leave_out(header, "zskelModelFromWorld"); },
        [](Imf::Header& header, std::vector<float>&) {
            header.insert("zskelTexelCentre", Imf::StringAttribute("i / (n - 1)"));
        },
        [](Imf::Header&, std::vector<float>& distance) { distance[5] = -1.0f; },
        [](Imf::Header&, std::vector<float>& distance) { distance[5] = std::nanf(""); },
        [](Imf::Header&, std::vector<float>& distance) { distance[5] = kInfinity; },
        [](Imf::Header&, std::vector<float>& distance) { distance[5] *= 1.01f; },
    };
    for (const auto& change : changes) {
        write_changed(path, bad, change);
        CHECK_THROWS_AS(read_depth_exr(bad), InputError);
    }
    std::filesystem::remove(path);
    std::filesystem::remove(bad);
}

TEST_CASE("read_depth_exr: no file, another file and a cut file are InputErrors that name it") {
    const std::string path = temporary("_cut.exr");
    write_depth_exr(path, make_dump());
    const std::string bytes = bytes_of(path);
    for (const std::size_t kept :
         {std::size_t{0}, std::size_t{3}, std::size_t{200}, bytes.size() / 2, bytes.size() - 1}) {
        write_bytes(path, bytes.substr(0, kept));
        CAPTURE(kept);
        try {
            read_depth_exr(path);
            FAIL("nothing was thrown");
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find(path) != std::string::npos);
        }
    }
    std::filesystem::remove(path);
    CHECK_THROWS_AS(read_depth_exr(path), InputError);
}

TEST_CASE("write_depth_exr: a folder that is not there is an IoError") {
    CHECK_THROWS_AS(write_depth_exr("/no/such/folder/x.exr", make_dump()), IoError);
}

// For check_exr.py, which reads the file with programs that share no code with ours.
TEST_CASE("write_depth_exr: the known map for independent readers" *
          doctest::skip(std::getenv("ZSKEL_EXR_OUT") == nullptr)) {
    DepthDump dump;
    dump.face_px = 4;
    for (std::uint32_t i = 0; i < 96; ++i) {
        dump.distance.push_back(i == 7 ? kInfinity : 1.0f + static_cast<float>(i) / 3.0f);
        dump.id.push_back(i == 7 ? kNone : 4'000'000'000u + i);
    }
    dump.eye_model = {0.1, 1.0 / 3.0, -1e-17};
    dump.eye_world = {0.5f, 0.25f, -0.125f};
    dump.step = 42;
    dump.force = {{1.0 / 7.0, 2.0 / 7.0, -3.0 / 7.0}, 1.0 / 9.0, 1.0 / 11.0};
    dump.near_plane = kNearPlane;
    dump.world_from_model = {{1.0, 2.0, 3.0}, 0.1};
    dump.model = "known.obj";
    dump.backend = "test";
    dump.version = "9.9.9";
    write_depth_exr(std::getenv("ZSKEL_EXR_OUT"), dump);
}
