// zskel doctor: every way to a GL context, what it gives, and what to do about those that fail; and
// what a batch can count on.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "batch/machine.h"
#include "command.h"
#include "zskel/visibility/cpu_source.h"

namespace zskel::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string advice(const gl::Diagnosis& found) {
    if (found.usable) return "";
    if (found.candidate == "OSMesa") {
        return "optional; Debian: apt-get install libosmesa6 (Mesa 25.1 and later have none)";
    }
    if (found.candidate == "EGL") return "Debian: apt-get install libegl1 libgl1-mesa-dri";
    if (found.candidate.starts_with("EGL hardware")) {
        return "check the driver's EGL files; in a container the GPU needs the 'graphics' "
               "capability";
    }
    return "Debian: apt-get install libegl1 libgl1-mesa-dri";
}

Json to_json(const gl::Diagnosis& found) {
    Json out{{"candidate", found.candidate}, {"usable", found.usable}};
    if (!found.usable) {
        out["reason"] = found.reason;
        out["advice"] = advice(found);
        return out;
    }
    out["kind"] = gl::name_of(found.info.kind);
    out["vendor"] = found.info.vendor;
    out["renderer"] = found.info.renderer;
    out["version"] = found.info.version;
    out["max_layers"] = found.info.max_layers;
    out["max_texture_px"] = found.info.max_texture_px;
    out["max_samples"] = found.info.max_samples;
    out["seconds_to_open"] = found.info.seconds;
    return out;
}

std::string to_text(const gl::Diagnosis& found) {
    if (!found.usable) {
        return fmt::format("fails  {}\n       {}\n       {}\n", found.candidate, found.reason,
                           advice(found));
    }
    const gl::ContextInfo& info = found.info;
    return fmt::format(
        "works  {}: {}, {}\n       {}; {} layers, {} px, {} samples; opened in {:.0f} ms\n",
        found.candidate, info.vendor, info.renderer, info.version, info.max_layers,
        info.max_texture_px, info.max_samples, info.seconds * 1e3);
}

constexpr double kMiB = 1 << 20;

Json batch_json() {
    const batch::Machine machine = batch::look_at_machine();
    const std::size_t workers = batch::recommended_workers(machine);
    return {{"cores", machine.cores},
            {"memory_mib", static_cast<std::size_t>(machine.memory_bytes / kMiB)},
            {"memory_of_a_worker_mib", static_cast<std::size_t>(batch::kWorkerBytes / kMiB)},
            {"memory_share_mib",
             static_cast<std::size_t>(batch::memory_for_worker(machine, workers) / kMiB)},
            {"has_gpu", machine.has_gpu},
            {"workers", workers}};
}

std::string batch_text() {
    const batch::Machine machine = batch::look_at_machine();
    const std::size_t workers = batch::recommended_workers(machine);
    std::string text = fmt::format(
        "zskel batch: {} cores and {:.0f} MiB free: --workers {}, one thread and at most {:.0f} "
        "MiB "
        "each;\n{:.0f} MiB are enough for models of 100,000 faces by the CPU\n",
        machine.cores, machine.memory_bytes / kMiB, workers,
        batch::memory_for_worker(machine, workers) / kMiB, batch::kWorkerBytes / kMiB);
    text += machine.has_gpu ? "  all workers share the GPU by one process and one context\n"
                            : "  no GPU's device file is there\n";
    return text;
}

ExitCode diagnose(bool as_json) {
    const std::vector<gl::Diagnosis> all = gl::diagnose_contexts({});
    const auto first =
        std::find_if(all.begin(), all.end(), [](const gl::Diagnosis& d) { return d.usable; });
    const std::string taken = first == all.end() ? "" : std::string(gl::name_of(first->info.kind));
    const bool has_gpu = std::any_of(all.begin(), all.end(), [](const gl::Diagnosis& d) {
        return d.usable && d.info.kind == gl::ContextKind::EglHardware;
    });
    if (as_json) {
        Json candidates = Json::array();
        for (const gl::Diagnosis& found : all) candidates.push_back(to_json(found));
        const Json out{
            {"program_version", ZSKEL_VERSION},
            {"needs",
             {{"opengl", "4.5 core"}, {"extension", "GL_ARB_shader_viewport_layer_array"}}},
            {"candidates", candidates},
            {"gl_takes", taken.empty() ? Json(nullptr) : Json(taken)},
            {"cpu", {{"instruction_set", cpu_instruction_set()}}},
            {"auto_takes", has_gpu ? "cpu or gpu" : "cpu"},
            {"batch", batch_json()}};
        print(out.dump(2) + "\n");
        return ExitCode::Ok;
    }
    std::string text =
        "GL contexts (OpenGL 4.5 core with GL_ARB_shader_viewport_layer_array is needed):\n";
    for (const gl::Diagnosis& found : all) text += to_text(found);
    text += fmt::format("--backend gl takes: {}\n", taken.empty() ? "nothing; it fails" : taken);
    text += fmt::format(
        "The CPU's Z-buffer (registers: {}) and rays (Embree) always work.\n"
        "--backend auto takes: {}\n",
        cpu_instruction_set(),
        has_gpu ? "cpu, or the GPU for as much work as pays for opening it" : "cpu");
    print(text + batch_text());
    return ExitCode::Ok;
}

}  // namespace

void add_doctor_command(CLI::App& app, const Common&, Run& run) {
    CLI::App* command =
        app.add_subcommand("doctor", "Say which backends work here, and why others do not");
    auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print JSON");
    command->footer("Examples:\n  zskel doctor\n  zskel doctor --json > machine.json");
    command->callback([&run, as_json] { run = [as_json] { return diagnose(*as_json); }; });
}

}  // namespace zskel::cli
