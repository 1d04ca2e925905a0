// What one eye's record (force, Jacobian, nearest distance, shares) costs by each source: one
// thread, eyes as `compare` takes them. Names are SOURCE/TEXELS ALONG A FACE/MODEL; `us_per_eye` is
// the figure.
//   zskel_bench_sources [Google Benchmark's options] MODEL...
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "read_back.h"
#include "subject.h"
#include "zskel/core/error.h"
#include "zskel/core/parallel.h"

namespace zskel::bench {
namespace {

struct Source {
    const char* name;
    BackendKind kind;
    int face_px;
    int rays;
    bool reads_back;
};
constexpr Source kSources[] = {
    {"cpu", BackendKind::Cpu, 16, 0, false},     {"cpu", BackendKind::Cpu, 8, 0, false},
    {"ray", BackendKind::Ray, 16, 0, false},     {"ray", BackendKind::Ray, 8, 0, false},
    {"ray197", BackendKind::Ray, 0, 197, false}, {"gl", BackendKind::Gl, 16, 0, false},
    {"gl-maps", BackendKind::Gl, 16, 0, true},
};
constexpr int kEyes = 240;
constexpr int kSlowEyes = 48;  // software GL

std::unique_ptr<Backend> open(const Source& source) {
    BackendOptions options;
    options.kind = source.kind;
    options.exact = true;
    if (source.face_px > 0) options.face_px = source.face_px;
    options.rays = source.rays;
    return open_backend(options);
}

void look(benchmark::State& state, const Subject& subject, const Source& source) {
    try {
        const auto backend = open(source);
        const auto prepared = backend->prepare(subject.surface);
        ReadBack read_back(*prepared);
        const bool is_slow = source.kind == BackendKind::Gl;
        const auto eyes = std::span(subject.eyes).first(is_slow ? kSlowEyes : subject.eyes.size());
        std::vector<EyeRecord> records(eyes.size());
        for (auto _ : state) {
            (source.reads_back ? read_back : *prepared).look(eyes, records);
            benchmark::DoNotOptimize(records.data());
        }
        state.counters["us_per_eye"] = benchmark::Counter(
            static_cast<double>(eyes.size()) * 1e-6,
            benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
        state.SetLabel(backend->info().renderer);
    } catch (const Error& error) {
        state.SkipWithError(error.what());
    }
}

// Evaluations from which `auto` would take a GPU, were there one; 0: never.
std::size_t evaluations_for_gpu(std::size_t faces, int face_px) {
    for (std::size_t evaluations = 1000; evaluations < 1000000000;
         evaluations += evaluations / 50) {
        if (choose_source({faces, evaluations}, face_px, thread_count(), true).is_gpu)
            return evaluations;
    }
    return 0;
}

int run(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    for (const std::size_t faces : {2000, 8000, 32000, 128000, 700000}) {
        benchmark::AddCustomContext(fmt::format("gpu_from_evaluations_{}", faces),
                                    std::to_string(evaluations_for_gpu(faces, 16)));
    }
    set_thread_limit(1);
    try {
        const auto backend = open(kSources[0]);
        std::vector<std::unique_ptr<Subject>> subjects;
        for (int i = 1; i < argc; ++i)
            subjects.push_back(std::make_unique<Subject>(load_subject(argv[i], *backend, kEyes)));
        for (const auto& subject : subjects) {
            for (const Source& source : kSources) {
                const std::string name =
                    fmt::format("{}/{}/{}", source.name, source.face_px, subject->name);
                benchmark::RegisterBenchmark(name.c_str(), [&subject = *subject,
                                                            &source](benchmark::State& s) {
                    look(s, subject, source);
                })->UseRealTime();
            }
        }
        benchmark::RunSpecifiedBenchmarks();
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.code());
    }
}

}  // namespace
}  // namespace zskel::bench

int main(int argc, char** argv) {
    return zskel::bench::run(argc, argv);
}
