// Where a texel lies in the file is never spelled out here: its direction goes through OpenEXR's
// own CubeMap functions. The bases of the faces as they lie in the file, which readers need, follow
// from that.
#include "zskel/io/depth_exr.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmap.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "zskel/core/assert.h"
#include "zskel/core/error.h"
#include "zskel/io/output_file.h"
#include "zskel/visibility/cube_map.h"

namespace zskel {
namespace {

constexpr std::string_view kTexelCentre =
    "texel i of n is centred at (i + 1/2) / n of its face; OpenEXR's own formula, i / (n - 1), "
    "puts the "
    "outermost on the cube's edges, half a texel off";
constexpr std::string_view kUnits =
    "Z and distance in world lengths, force and meanInverseDistance in 1 / world length; world = "
    "(model - "
    "center) * scale; modelFromWorld multiplies row vectors";
constexpr const char* kFaceNames[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

Imath::Box2i window_of(int face_px) {
    return {{0, 0}, {face_px - 1, 6 * face_px - 1}};
}

// Pixel of every texel, as an offset from the data window's first.
std::vector<std::size_t> pixels_of_texels(int face_px) {
    const Imath::Box2i window = window_of(face_px);
    const auto n = static_cast<std::size_t>(face_px);
    std::vector<std::size_t> pixels(6 * n * n);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const DVec3 d = texel_direction(texel_at(i, face_px), face_px);
        Imf::CubeMapFace face{};
        Imath::V2f in_face;
        Imf::CubeMap::faceAndPixelPosition(Imath::V3f(Imath::V3d(d.x, d.y, d.z)), window, face,
                                           in_face);
        // Its pixel centres are not ours: the nearest one is meant.
        const Imath::V2f at = Imf::CubeMap::pixelPosition(
            face, window, {std::round(in_face.x), std::round(in_face.y)});
        pixels[i] = static_cast<std::size_t>(std::lround(at.y)) * n +
                    static_cast<std::size_t>(std::lround(at.x));
    }
    return pixels;
}

// A face as it lies in the file: direction = forward + u right + v down, u and v from -1 to 1.
std::string face_bases(int face_px, const std::vector<std::size_t>& pixels) {
    const auto n = static_cast<std::size_t>(face_px);
    std::vector<std::size_t> texels(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) texels[pixels[i]] = i;
    const auto direction = [&](std::size_t pixel) {
        return texel_direction(texel_at(texels[pixel], face_px), face_px);
    };
    const auto text = [](const DVec3& v) {
        return fmt::format("{} {} {}", std::lround(v.x), std::lround(v.y), std::lround(v.z));
    };
    std::string bases;
    for (std::size_t face = 0; face < 6; ++face) {
        const std::size_t first = face * n * n;
        const DVec3 corner = direction(first);
        const DVec3 across = direction(first + n - 1);
        const DVec3 below = direction(first + n * (n - 1));
        bases += fmt::format("{}{}: right {}, down {}, forward {}", face == 0 ? "" : "; ",
                             kFaceNames[face], text(glm::normalize(across - corner)),
                             text(glm::normalize(below - corner)), text((across + below) * 0.5));
    }
    return bases;
}

float axial(float radial, std::size_t texel, int face_px) {
    const double length = glm::length(texel_direction(texel_at(texel, face_px), face_px));
    return static_cast<float>(static_cast<double>(radial) / length);
}

// Machines may round the last bit of axial's length differently.
bool is_close(float a, float b) {
    return a == b || std::abs(a - b) <= 1e-6f * b;
}

// The three channels in the file's order.
struct Pixels {
    std::vector<float> depth;
    std::vector<float> distance;
    std::vector<unsigned int> id;

    explicit Pixels(std::size_t count) : depth(count), distance(count), id(count) {}

    Imf::FrameBuffer frame_buffer(int face_px) {
        Imf::FrameBuffer frame;
        const std::size_t row = sizeof(float) * static_cast<std::size_t>(face_px);
        const auto add = [&](const char* name, Imf::PixelType type, void* data) {
            frame.insert(name, Imf::Slice(type, static_cast<char*>(data), sizeof(float), row));
        };
        add("Z", Imf::FLOAT, depth.data());
        add("distance", Imf::FLOAT, distance.data());
        add("id", Imf::UINT, id.data());
        return frame;
    }
};
static_assert(sizeof(unsigned int) == sizeof(float));

Imath::V3d to_imath(const DVec3& v) {
    return {v.x, v.y, v.z};
}
DVec3 from_imath(const Imath::V3d& v) {
    return {v.x, v.y, v.z};
}

Imath::M44d model_from_world(const Similarity& s) {
    const double k = 1.0 / s.scale;
    return {k, 0, 0, 0, 0, k, 0, 0, 0, 0, k, 0, s.center.x, s.center.y, s.center.z, 1};
}

Imf::Header header_of(const DepthDump& dump, std::string_view bases) {
    Imf::Header header(window_of(dump.face_px), window_of(dump.face_px));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.channels().insert("distance", Imf::Channel(Imf::FLOAT));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    const auto text = [&](const char* name, std::string_view value) {
        header.insert(name, Imf::StringAttribute(std::string(value)));
    };
    const auto number = [&](const char* name, double value) {
        header.insert(name, Imf::DoubleAttribute(value));
    };
    text("zskelTexelCentre", kTexelCentre);
    text("zskelUnits", kUnits);
    text("zskelModel", dump.model);
    text("zskelBackend", dump.backend);
    text("zskelVersion", dump.version);
    text("zskelFaceBases", bases);
    header.insert("zskelEyeModel", Imf::V3dAttribute(to_imath(dump.eye_model)));
    const Vec3& eye = dump.eye_world;
    header.insert("zskelEyeWorld", Imf::V3fAttribute({eye.x, eye.y, eye.z}));
    header.insert("zskelStep", Imf::IntAttribute(dump.step));
    header.insert("zskelForce", Imf::V3dAttribute(to_imath(dump.force.vector)));
    number("zskelMeanInverseDistance", dump.force.mean_inverse_distance);
    number("zskelHitFraction", dump.force.hit_fraction);
    header.insert("zskelNearPlane", Imf::FloatAttribute(dump.near_plane));
    header.insert("zskelCenter", Imf::V3dAttribute(to_imath(dump.world_from_model.center)));
    number("zskelScale", dump.world_from_model.scale);
    header.insert("zskelModelFromWorld",
                  Imf::M44dAttribute(model_from_world(dump.world_from_model)));
    return header;
}

// Reads one file; every complaint is an InputError that names it.
class Reader {
  public:
    explicit Reader(const std::string& path) : path_(path), file_(path.c_str()) {}

  private:
    void require(bool fine, std::string_view problem) const {
        if (!fine) throw InputError(fmt::format("{}: no depth map of zskel's: {}", path_, problem));
    }

    template <typename Attribute>
    const auto& value(const char* name) const {
        const auto* attribute = file_.header().findTypedAttribute<Attribute>(name);
        require(attribute != nullptr,
                fmt::format("attribute {} is missing or of another type", name));
        return attribute->value();
    }

    double finite(const char* name) const {
        const double number = value<Imf::DoubleAttribute>(name);
        require(std::isfinite(number), fmt::format("{} is {}", name, number));
        return number;
    }

    DVec3 finite_point(const char* name) const {
        const DVec3 point = from_imath(value<Imf::V3dAttribute>(name));
        require(is_finite(point), fmt::format("{} is {} {} {}", name, point.x, point.y, point.z));
        return point;
    }

    static bool is_finite(const DVec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    }

    // Texels along a face.
    int check_layout() const {
        const Imf::Header& header = file_.header();
        require(Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE,
                "it is no cube environment map");
        const Imath::Box2i& window = header.dataWindow();
        const int face_px = window.max.x + 1;
        require(face_px >= kMinFacePx && face_px <= kMaxFacePx && window == window_of(face_px),
                fmt::format("its data window is ({} {}) - ({} {})", window.min.x, window.min.y,
                            window.max.x, window.max.y));
        const auto check = [&](const char* name, Imf::PixelType type) {
            const Imf::Channel* channel = header.channels().findChannel(name);
            require(channel != nullptr && channel->type == type && channel->xSampling == 1 &&
                        channel->ySampling == 1,
                    fmt::format("channel {} is missing or of another type", name));
        };
        check("Z", Imf::FLOAT);
        check("distance", Imf::FLOAT);
        check("id", Imf::UINT);
        return face_px;
    }

    void read_attributes(DepthDump& dump) const {
        dump.model = value<Imf::StringAttribute>("zskelModel");
        dump.backend = value<Imf::StringAttribute>("zskelBackend");
        dump.version = value<Imf::StringAttribute>("zskelVersion");
        dump.eye_model = finite_point("zskelEyeModel");
        const Imath::V3f& eye = value<Imf::V3fAttribute>("zskelEyeWorld");
        dump.eye_world = {eye.x, eye.y, eye.z};
        require(is_finite(DVec3(dump.eye_world)), "zskelEyeWorld is not finite");
        dump.step = value<Imf::IntAttribute>("zskelStep");
        require(dump.step >= 0, "zskelStep is negative");
        dump.force.vector = finite_point("zskelForce");
        dump.force.mean_inverse_distance = finite("zskelMeanInverseDistance");
        dump.force.hit_fraction = finite("zskelHitFraction");
        dump.near_plane = value<Imf::FloatAttribute>("zskelNearPlane");
        require(std::isfinite(dump.near_plane) && dump.near_plane >= 0.0f,
                "zskelNearPlane is no length");
        dump.world_from_model.center = finite_point("zskelCenter");
        dump.world_from_model.scale = finite("zskelScale");
        require(dump.world_from_model.scale > 0.0, "zskelScale is not positive");
        require(value<Imf::M44dAttribute>("zskelModelFromWorld") ==
                    model_from_world(dump.world_from_model),
                "zskelModelFromWorld disagrees with zskelCenter and zskelScale");
    }

    void read_pixels(DepthDump& dump, const std::vector<std::size_t>& pixels) {
        Pixels data(pixels.size());
        file_.setFrameBuffer(data.frame_buffer(dump.face_px));
        file_.readPixels(0, 6 * dump.face_px - 1);
        dump.distance.resize(pixels.size());
        dump.id.resize(pixels.size());
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const float distance = data.distance[pixels[i]];
            const unsigned int id = data.id[pixels[i]];
            const bool is_right = distance > 0.0f && std::isfinite(distance) == (id != kNone) &&
                                  is_close(data.depth[pixels[i]], axial(distance, i, dump.face_px));
            require(
                is_right,
                fmt::format("pixel {} holds distance {}, Z {} and id {}, which do not go together",
                            pixels[i], distance, data.depth[pixels[i]], id));
            dump.distance[i] = distance;
            dump.id[i] = id;
        }
    }

    const std::string& path_;
    Imf::InputFile file_;

  public:
    DepthDump read() {
        DepthDump dump;
        dump.face_px = check_layout();
        const std::vector<std::size_t> pixels = pixels_of_texels(dump.face_px);
        require(value<Imf::StringAttribute>("zskelTexelCentre") == kTexelCentre,
                "another rule for texel centres");
        require(value<Imf::StringAttribute>("zskelUnits") == kUnits, "other units");
        require(value<Imf::StringAttribute>("zskelFaceBases") == face_bases(dump.face_px, pixels),
                "other face bases");
        read_attributes(dump);
        read_pixels(dump, pixels);
        return dump;
    }
};

}  // namespace

void write_depth_exr(const std::string& path, const DepthDump& dump) {
    check_face_px(dump.face_px);
    const std::vector<std::size_t> pixels = pixels_of_texels(dump.face_px);
    ZSKEL_ASSERT(dump.distance.size() == pixels.size() && dump.id.size() == pixels.size(),
                 "a whole map");
    Pixels data(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        data.distance[pixels[i]] = dump.distance[i];
        data.depth[pixels[i]] = axial(dump.distance[i], i, dump.face_px);
        data.id[pixels[i]] = dump.id[i];
    }
    const Imf::Header header = header_of(dump, face_bases(dump.face_px, pixels));
    // Through memory: an OutputFile of its own loses the errors of its last writes.
    Imf::StdOSStream stream;
    try {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(data.frame_buffer(dump.face_px));
        file.writePixels(6 * dump.face_px);
    } catch (const std::exception& error) {
        throw IoError(fmt::format("{}: cannot write: {}", path, error.what()));
    }
    write_output_text(path, stream.str());
}

DepthDump read_depth_exr(const std::string& path) {
    try {
        return Reader(path).read();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: {}", path, error.what()));
    }
}

}  // namespace zskel
