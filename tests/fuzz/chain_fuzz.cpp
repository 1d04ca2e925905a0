// Any bytes as a small mesh, which is checked and whose skeleton is extracted and written. The
// first byte chooses how; then come either the text of an OBJ file or packed numbers, see
// `unpack_mesh`.
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "fuzz.h"
#include "zskel/core/log.h"
#include "zskel/core/parallel.h"
#include "zskel/extract.h"
#include "zskel/io/report.h"
#include "zskel/io/skeleton_json.h"
#include "zskel/mesh/check.h"
#include "zskel/mesh/make_mesh.h"
#include "zskel/mesh/read_mesh.h"

using namespace zskel;

namespace {

constexpr std::size_t kMostFaces = 64;
constexpr std::size_t kMostVertices = 40;
constexpr int kFacePx = 4;

/// The bits of the first byte.
enum Choice : std::uint8_t { kText = 1, kPaper = 2, kRays = 4, kContour = 8, kResample = 16 };

std::unique_ptr<Backend> open(BackendKind kind) {
    BackendOptions options;
    options.kind = kind;
    options.face_px = kFacePx;
    return open_backend(options);
}

/// A count of vertices, a power of two that scales them, how many units of 64 they are moved along
/// x; then three bytes a vertex, and three a triangle.
Mesh unpack_mesh(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 3) throw InputError("too few bytes");
    const std::size_t wanted = 3 + bytes[0] % (kMostVertices - 2);
    const double scale = std::ldexp(1.0, static_cast<std::int8_t>(bytes[1]));
    const double shift = 64.0 * static_cast<std::int8_t>(bytes[2]);
    bytes = bytes.subspan(3);
    const std::size_t vertices = std::min(wanted, bytes.size() / 3);
    std::vector<double> xyz;
    for (std::size_t i = 0; i < 3 * vertices; ++i)
        xyz.push_back((static_cast<std::int8_t>(bytes[i]) + (i % 3 == 0 ? shift : 0.0)) * scale);
    bytes = bytes.subspan(3 * vertices);
    std::vector<std::uint32_t> corners;
    for (const std::uint8_t byte : bytes.first(std::min(bytes.size() / 3, kMostFaces) * 3))
        corners.push_back(static_cast<std::uint32_t>(byte % std::max<std::size_t>(vertices, 1)));
    return make_mesh(xyz.data(), vertices, corners.data(), corners.size() / 3, "packed");
}

Mesh mesh_of(std::uint8_t choice, std::span<const std::uint8_t> bytes) {
    if ((choice & kText) == 0) return unpack_mesh(bytes);
    return parse_mesh(std::as_bytes(bytes), MeshFormat::Obj, "text", {.max_faces = kMostFaces});
}

ExtractOptions options_of(std::uint8_t choice) {
    ExtractOptions options;
    options.method = (choice & kPaper) != 0 ? Method::Paper : Method::Newton;
    options.paper.steps.step_world = 0.05;
    options.paper.steps.max_steps = 40;
    RefineOptions& refine = options.newton.refine;
    if ((choice & kContour) != 0) refine = active_contour();
    refine.min_spacing_world = refine.max_spacing_world = 0.1;
    refine.smoothing_sweeps = 2;
    refine.sweeps = 3;
    return options;
}

void check_graph(const Mesh& mesh, const ExtractResult& result) {
    const SkeletonGraph& graph = result.graph;
    fuzz::require(!graph.nodes.empty(), "a skeleton has nodes");
    for (const SkeletonGraph::Node& node : graph.nodes) {
        fuzz::require(std::isfinite(node.position.x) && std::isfinite(node.position.y) &&
                          std::isfinite(node.position.z) && std::isfinite(node.radius),
                      "nodes are finite");
    }
    for (const SkeletonGraph::Edge& edge : graph.edges) {
        fuzz::require(edge.source < edge.target && edge.target < graph.nodes.size(),
                      "edges join two nodes");
    }
    fuzz::require(graph.vertex_node.size() == mesh.positions.size(), "every vertex is told of");
    for (const std::uint32_t node : graph.vertex_node)
        fuzz::require(node == kNone || node < graph.nodes.size(), "a vertex has a node or none");
}

void run(std::uint8_t choice, std::span<const std::uint8_t> bytes) {
    static const std::unique_ptr<Backend> raster = open(BackendKind::Cpu);
    static const std::unique_ptr<Backend> rays = open(BackendKind::Ray);
    const Mesh mesh = mesh_of(choice, bytes);
    const MeshReport report = check_mesh(mesh);
    fuzz::require(!to_json(report).empty() && !to_text(report).empty(), "a report says something");
    ExtractOptions options = options_of(choice);
    if ((choice & kResample) != 0) options.newton.resample_model = report.box.diagonal() / 50.0;
    const ExtractResult result =
        extract_skeleton(mesh, options, (choice & kRays) != 0 ? *rays : *raster);
    check_graph(mesh, result);
    fuzz::require(!skeleton_json(result, Provenance{}, {.seeds = true}).empty(),
                  "a skeleton is written");
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    set_log(LogLevel::Off, LogFormat::Text);
    set_thread_limit(1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    fuzz::answer([&] { run(data[0], std::span(data + 1, size - 1)); });
    return 0;
}
