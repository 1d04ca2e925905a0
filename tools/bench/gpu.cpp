// What a GPU makes of it: records a second by how many eyes go at once, how far they are from the
// CPU's, and seconds to settle all seeds, per model.
//   zskel_bench_gpu [--face-px N] MODEL...
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "seconds_of.h"
#include "subject.h"
#include "zskel/core/error.h"
#include "zskel/core/parallel.h"
#include "zskel/extract.h"

namespace zskel::bench {
namespace {

constexpr int kEyes = 240;
constexpr int kRounds = 9;

double median_seconds(const std::function<void()>& work) {
    std::vector<double> all;
    for (int i = 0; i < kRounds; ++i) all.push_back(seconds_of(work));
    std::nth_element(all.begin(), all.begin() + kRounds / 2, all.end());
    return all[kRounds / 2];
}

std::unique_ptr<Backend> open(BackendKind kind, int face_px) {
    BackendOptions options;
    options.kind = kind;
    options.exact = true;
    options.face_px = face_px;
    return open_backend(options);
}

std::vector<EyeRecord> records_by(Backend& backend, const Subject& subject) {
    std::vector<EyeRecord> records(subject.eyes.size());
    backend.prepare(subject.surface)->look(subject.eyes, records);
    return records;
}

// Force off, over 1 / nearest, at 95 % of the eyes; and the Jacobian, over its own norm.
void print_difference(const Subject& subject, Backend& gpu, Backend& cpu) {
    const std::vector<EyeRecord> a = records_by(gpu, subject);
    const std::vector<EyeRecord> b = records_by(cpu, subject);
    std::vector<double> force;
    std::vector<double> jacobian;
    for (std::size_t e = 0; e < a.size(); ++e) {
        force.push_back(static_cast<double>(glm::length(a[e].force - b[e].force) * b[e].nearest));
        double off = 0.0;
        double norm = 0.0;
        for (std::size_t k = 0; k < 6; ++k) {
            off += std::pow(static_cast<double>(a[e].jacobian[k] - b[e].jacobian[k]), 2.0);
            norm += std::pow(static_cast<double>(b[e].jacobian[k]), 2.0);
        }
        jacobian.push_back(std::sqrt(off / norm));
    }
    std::sort(force.begin(), force.end());
    std::sort(jacobian.begin(), jacobian.end());
    const std::size_t p95 = force.size() * 95 / 100;
    fmt::print(
        "  records against the CPU's: force {:.1e} at 95 %, {:.1e} at worst; Jacobian "
        "{:.1e}, {:.1e}\n",
        force[p95], force.back(), jacobian[p95], jacobian.back());
}

void print_throughput(const Subject& subject, Backend& gpu, Backend& cpu) {
    const auto on_gpu = gpu.prepare(subject.surface);
    const auto on_cpu = cpu.prepare(subject.surface);
    for (const std::size_t count : {1, 1000, 8192, 65535}) {
        std::vector<Vec3> eyes;
        for (std::size_t i = 0; i < count; ++i)
            eyes.push_back(subject.eyes[i % subject.eyes.size()]);
        std::vector<EyeRecord> records(count);
        on_gpu->look(eyes, records);
        const double gpu_s = median_seconds([&] { on_gpu->look(eyes, records); });
        const double cpu_s = count > 8192 ? 0.0 : seconds_of([&] { on_cpu->look(eyes, records); });
        fmt::print("  {:>6} eyes at once: {:8.3f} ms, {:6.3f} million a second{}\n", count,
                   gpu_s * 1e3, static_cast<double>(count) * 1e-6 / gpu_s,
                   cpu_s > 0.0
                       ? fmt::format("; the CPU's {} threads {:.3f} million", thread_count(),
                                     static_cast<double>(count) * 1e-6 / cpu_s)
                       : "");
    }
}

// As the workers of a batch do: so many copies of a small solid, each with the eyes of a round.
void print_sharing(const Subject& subject, Backend& gpu) {
    for (const std::size_t eyes : {12, 100, 600}) {
        for (const std::size_t solids : {1, 4, 16, 64}) {
            std::vector<std::unique_ptr<VisibilitySource>> sources;
            std::vector<Vec3> all;
            for (std::size_t i = 0; i < eyes; ++i)
                all.push_back(subject.eyes[i % subject.eyes.size()]);
            std::vector<EyeRecord> records(eyes);
            std::vector<Look> looks;
            for (std::size_t i = 0; i < solids; ++i) {
                sources.push_back(gpu.prepare(subject.surface));
                looks.push_back({sources.back().get(), all, records});
            }
            gpu.look(looks);
            const double at_once = median_seconds([&] { gpu.look(looks); });
            const double in_turn = median_seconds([&] {
                for (const Look& look : looks) look.source->look(look.eyes, look.records);
            });
            fmt::print("  {:>3} solids of {:>3} eyes: {:7.3f} ms at once, {:7.3f} ms in turn\n",
                       solids, eyes, at_once * 1e3, in_turn * 1e3);
        }
    }
}

double stage_seconds(const ExtractResult& result, std::string_view name) {
    for (const StageTime& stage : result.statistics.stages) {
        if (stage.stage == name) return stage.seconds;
    }
    return 0.0;
}

// Twice by each: what a driver does at first use is told apart.
void print_settling(const std::string& path, Backend& gpu, Backend& cpu) {
    const Mesh mesh = read_mesh(path);
    for (Backend* backend : {&gpu, &cpu}) {
        for (int round = 0; round < 3; ++round) {
            const ExtractResult result = extract_skeleton(mesh, {}, *backend);
            fmt::print("  {}: {} evaluations settled in {:.2f} ms, everything {:.1f} ms\n",
                       backend->info().name, result.statistics.evaluations,
                       stage_seconds(result, "settle") * 1e3, result.statistics.seconds() * 1e3);
        }
    }
}

int run(int argc, char** argv) {
    CLI::App app("Cube maps on a GPU");
    int face_px = 16;
    std::vector<std::string> models;
    app.add_option("--face-px", face_px, "Texels along a cube face");
    app.add_option("models", models)->required();
    CLI11_PARSE(app, argc, argv);
    try {
        std::unique_ptr<Backend> gpu;
        const double opened = seconds_of([&] { gpu = open(BackendKind::Egl, face_px); });
        const auto cpu = open(BackendKind::Cpu, face_px);
        fmt::print("{} ({}, {}), opened in {:.0f} ms; 6x{}x{} texels\n", gpu->info().renderer,
                   gpu->info().name, gpu->info().version, opened * 1e3, face_px, face_px);
        for (const std::string& path : models) {
            const Subject subject = load_subject(path, *cpu, kEyes);
            fmt::print("{}\n", subject.name);
            print_difference(subject, *gpu, *cpu);
            print_throughput(subject, *gpu, *cpu);
            print_sharing(subject, *gpu);
            print_settling(path, *gpu, *cpu);
        }
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}

}  // namespace
}  // namespace zskel::bench

int main(int argc, char** argv) {
    return zskel::bench::run(argc, argv);
}
