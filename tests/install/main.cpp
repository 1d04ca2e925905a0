// What a caller of the installed library does: a mesh from arrays in memory, progress, cancelling,
// two threads, and a GL context of its own that must stay as it was.
#include <zskel/extract.h>
#include <zskel/mesh/make_mesh.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <numbers>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#ifdef WITH_EGL
#include "caller_context.h"
#endif

namespace {

std::atomic<long> live_blocks{0};  // of memory, by operator new

}  // namespace

void* operator new(std::size_t bytes) {
    void* block = std::malloc(bytes == 0 ? 1 : bytes);
    if (block == nullptr) throw std::bad_alloc();
    ++live_blocks;
    return block;
}
void operator delete(void* block) noexcept {
    if (block != nullptr) --live_blocks;
    std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
    operator delete(block);
}

namespace {

void require(bool fine, const std::string& what) {
    std::printf("%s: %s\n", fine ? "ok" : "FAILED", what.c_str());
    if (!fine) std::exit(1);
}

// A torus: one cycle.
zskel::Mesh torus() {
    constexpr std::uint32_t kAround = 32;
    constexpr std::uint32_t kAcross = 12;
    std::vector<float> xyz;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < kAround; ++i) {
        for (std::uint32_t k = 0; k < kAcross; ++k) {
            const double a = 2 * std::numbers::pi * i / kAround;
            const double b = 2 * std::numbers::pi * k / kAcross;
            const double ring = 3 + std::cos(b);
            for (const double c : {ring * std::cos(a), ring * std::sin(a), std::sin(b)})
                xyz.push_back(static_cast<float>(c));
            const std::uint32_t j = (i + 1) % kAround;
            const std::uint32_t l = (k + 1) % kAcross;
            for (const std::uint32_t corner : {i * kAcross + k, j * kAcross + k, j * kAcross + l,
                                               i * kAcross + k, j * kAcross + l, i * kAcross + l})
                corners.push_back(corner);
        }
    }
    return zskel::make_mesh(xyz.data(), xyz.size() / 3, corners.data(), corners.size() / 3,
                            "torus");
}

std::unique_ptr<zskel::Backend> open(zskel::BackendKind kind) {
    zskel::BackendOptions options;
    options.kind = kind;
    options.face_px = 8;
    return zskel::open_backend(options);
}

bool is_same(const zskel::SkeletonGraph& a, const zskel::SkeletonGraph& b) {
    const auto same_node = [](const auto& l, const auto& r) {
        return l.position == r.position && l.radius == r.radius;
    };
    const auto same_edge = [](const auto& l, const auto& r) {
        return l.source == r.source && l.target == r.target;
    };
    return a.vertex_node == b.vertex_node &&
           std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node) &&
           std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge);
}

void check_bad_arrays() {
    const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t corners[] = {0, 1, 3};
    bool refused = false;
    try {
        zskel::make_mesh(xyz, 3, corners, 1);
    } catch (const zskel::InputError& error) {
        refused = std::string(error.what()).find("triangle 0") != std::string::npos;
    }
    require(refused, "a corner that is no vertex is refused");
}

std::vector<std::string> check_progress(const zskel::Mesh& mesh, zskel::Backend& backend) {
    std::vector<std::string> stages;
    bool is_share = true;
    bool is_here = true;
    zskel::ExtractOptions options;
    options.progress = [&, caller = std::this_thread::get_id()](std::string_view stage,
                                                                double share) {
        is_share = is_share && share >= 0.0 && share <= 1.0;
        is_here = is_here && std::this_thread::get_id() == caller;
        if (std::find(stages.begin(), stages.end(), stage) == stages.end())
            stages.emplace_back(stage);
        return true;
    };
    zskel::extract_skeleton(mesh, options, backend);
    require(stages.size() > 4 && is_share, "progress is told of every stage");
    require(is_here, "progress is told on the caller's thread");
    return stages;
}

bool cancels(const zskel::Mesh& mesh, zskel::Backend& backend, const std::string& at) {
    zskel::ExtractOptions options;
    options.progress = [&](std::string_view stage, double) { return stage != at; };
    try {
        zskel::extract_skeleton(mesh, options, backend);
    } catch (const zskel::Cancelled&) {
        return true;
    }
    return false;
}

void check_cancel(const zskel::Mesh& mesh, zskel::Backend& backend,
                  const std::vector<std::string>& stages) {
    constexpr long kRounds = 4;
    long before = 0;
    bool all = true;
    for (long round = 0; round <= kRounds; ++round) {
        if (round == 1) before = live_blocks;  // the first may set up what stays
        for (const std::string& stage : stages) all = cancels(mesh, backend, stage) && all;
    }
    const long grown = live_blocks - before;
    require(all, "the work is cancelled at every stage");
    require(grown < kRounds, "cancelling leaves no memory behind: " + std::to_string(grown) +
                                 " blocks after " + std::to_string(kRounds) + " rounds");
}

void check_threads(const zskel::Mesh& mesh, zskel::BackendKind kind,
                   const zskel::SkeletonGraph& expected) {
    zskel::SkeletonGraph found[2];
    const auto work = [&](zskel::SkeletonGraph& graph) {
        graph = zskel::extract_skeleton(mesh, {}, *open(kind)).graph;
    };
    std::thread first(work, std::ref(found[0]));
    std::thread second(work, std::ref(found[1]));
    first.join();
    second.join();
    require(is_same(found[0], expected) && is_same(found[1], expected),
            std::string("two threads, a backend each, get the same: ") +
                std::string(zskel::name_of(kind)));
}

// False when there is no GL context to be had.
bool check_own_context(const zskel::Mesh& mesh) {
#ifdef WITH_EGL
    const auto own = CallerContext::open();
    if (own == nullptr) return false;
    const std::string before = own->state();
    auto backend = open(zskel::BackendKind::Gl);
    const auto graph = zskel::extract_skeleton(mesh, {}, *backend).graph;
    const std::string during = own->state();
    const std::string name = backend->info().name;
    backend.reset();
    const std::string after = own->state();
    std::printf("%s\n", before.c_str());
    if (during != before) std::printf("with %s: %s\n", name.c_str(), during.c_str());
    if (after != before) std::printf("after it: %s\n", after.c_str());
    require(during == before && after == before, "the caller's own context is as it was: " + name);
    check_threads(mesh, zskel::BackendKind::Gl, graph);
    return true;
#else
    static_cast<void>(mesh);
    return false;
#endif
}

}  // namespace

int main() {
    check_bad_arrays();
    const zskel::Mesh mesh = torus();
    const auto backend = open(zskel::BackendKind::Ray);
    const zskel::SkeletonGraph graph = zskel::extract_skeleton(mesh, {}, *backend).graph;
    require(!graph.nodes.empty() && graph.edges.size() == graph.nodes.size(),
            "the torus is one cycle: " + std::to_string(graph.nodes.size()) + " nodes");
    check_cancel(mesh, *backend, check_progress(mesh, *backend));
    require(is_same(zskel::extract_skeleton(mesh, {}, *backend).graph, graph),
            "after cancelling, the backend answers as before");
    check_threads(mesh, zskel::BackendKind::Ray, graph);
    if (check_own_context(mesh)) return 0;
    const char* wanted = std::getenv("ZSKEL_REQUIRE_GL");
    require(wanted == nullptr || std::string(wanted) != "1", "GL is not asked for");
    std::puts("no EGL context here: a caller's own context was not tried");
}
