// zskel doctor: every way to a GL context, what it gives, and what to do about those that fail.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

ExitCode diagnose(bool as_json) {
    const std::vector<gl::Diagnosis> all = gl::diagnose_contexts({});
    const auto first =
        std::find_if(all.begin(), all.end(), [](const gl::Diagnosis& d) { return d.usable; });
    const std::string taken = first == all.end() ? "" : std::string(gl::name_of(first->info.kind));
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
            {"auto_takes", "cpu"}};
        print(out.dump(2) + "\n");
        return ExitCode::Ok;
    }
    std::string text =
        "GL contexts (OpenGL 4.5 core with GL_ARB_shader_viewport_layer_array is needed):\n";
    for (const gl::Diagnosis& found : all) text += to_text(found);
    text += fmt::format("--backend gl takes: {}\n", taken.empty() ? "nothing; it fails" : taken);
    text += fmt::format(
        "The CPU's Z-buffer (registers: {}) and rays (Embree) always work.\n"
        "--backend auto takes: cpu\n",
        cpu_instruction_set());
    print(text);
    return ExitCode::Ok;
}

}  // namespace

void add_doctor_command(CLI::App& app, const Common&, Run& run) {
    CLI::App* command =
        app.add_subcommand("doctor", "Say which backends work here, and why others do not");
    auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print JSON");
    command->callback([&run, as_json] { run = [as_json] { return diagnose(*as_json); }; });
}

}  // namespace zskel::cli
