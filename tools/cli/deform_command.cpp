// zskel deform: a mesh and a pose in, the mesh in that pose out, or on its way there (the paper's
// Figure 5).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>

#include "command.h"
#include "demos_sources.h"
#include "rig_model.h"
#include "zskel/core/input_file.h"
#include "zskel/io/output_file.h"
#include "zskel/io/picture.h"
#include "zskel/io/rig_glb.h"
#include "zskel/io/write_mesh.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/rig/skinning.h"

namespace zskel::cli {
namespace {

constexpr double kKeysPerSecond = 30.0;

struct Arguments {
    std::string model;
    std::string pose;
    std::string demo;
    std::string output;
    std::string strip;
    int strip_frames = 6;
    int frames = 0;
    PictureOptions picture{.width_px = 300, .height_px = 480, .view = {}};
    RigOptions rig;
    Skinning skinning = Skinning::DualQuaternion;
};

// A model of ours with a pose that shows something.
struct Demo {
    const char* name;
    std::string_view model;
    std::string_view pose;
    const char* view;
};
constexpr std::array<Demo, 1> kDemos = {{{"hand", demos::kHandObj, demos::kHandPoseJson, "35,20"}}};

// The pose at even times from rest to all of it.
std::vector<RigKey> steps_of(const Armature& armature, const Pose& pose, int count) {
    std::vector<RigKey> steps;
    for (int i = 0; i < count; ++i) {
        const double share = count == 1 ? 1.0 : i / static_cast<double>(count - 1);
        const double seconds = share * duration(pose);
        steps.push_back({seconds, bone_motions(armature, pose_at(pose, seconds))});
    }
    return steps;
}

// The parts of a task that each output needs.
struct Posed {
    Mesh mesh;
    RiggedModel rig;
    Pose pose;
};

std::string measures_text(const Mesh& mesh, const DeformMeasures& m) {
    return fmt::format(
        "volume          {}\nflipped faces   {} of {}\ncrossing faces  {}, at rest {}\n"
        "edge stretch    median {:.4f}, at 99 % of the edges {:.3f}, worst {:.2f}\n"
        "farthest moved  {:.4f} of the diagonal\n",
        m.volume_change ? fmt::format("{:+.3f} %", 100.0 * *m.volume_change)
                        : "none: the surface is open",
        m.flipped_faces, mesh.triangles.size(), m.crossing_faces, m.crossing_at_rest,
        m.edge_stretch_median, m.edge_stretch_p99, m.edge_stretch_worst, m.farthest);
}

std::string measures_row(std::size_t number, double seconds, const DeformMeasures& m) {
    return fmt::format(
        "{:>5} {:>8.2f} {:>10} {:>8} {:>9} {:>9.3f} {:>9.4f}\n", number, seconds,
        m.volume_change ? fmt::format("{:+.3f} %", 100.0 * *m.volume_change) : "open",
        m.flipped_faces, m.crossing_faces, m.edge_stretch_p99, m.farthest);
}

bool is_animation(const std::string& path) {
    return std::filesystem::path(path).extension() == ".glb";
}

// "walk.obj" to "walk_0007.obj".
std::string numbered(const std::string& path, std::size_t number) {
    std::filesystem::path out(path);
    out.replace_filename(
        fmt::format("{}_{:04}{}", out.stem().string(), number, out.extension().string()));
    return out.string();
}

std::vector<std::string> mesh_files(const Arguments& arguments) {
    if (arguments.frames == 0) return {arguments.output};
    if (arguments.output == "-")
        throw UsageError("--frames writes files; standard output holds only one");
    std::vector<std::string> files;
    for (int i = 1; i <= arguments.frames; ++i)
        files.push_back(numbered(arguments.output, static_cast<std::size_t>(i)));
    return files;
}

void write_animation(const Arguments& arguments, const Posed& posed, const Common& common) {
    const int default_frames =
        static_cast<int>(std::ceil(duration(posed.pose) * kKeysPerSecond)) + 1;
    const int frames = arguments.frames > 0 ? arguments.frames : default_frames;
    const std::vector<RigKey> keys = steps_of(posed.rig.armature, posed.pose, frames);
    write_output_text(arguments.output, write_rig_glb(posed.mesh, posed.rig.armature,
                                                      posed.rig.weights, keys, common.command));
}

void write_meshes(const Arguments& arguments, const Posed& posed, const Common& common) {
    const std::vector<std::string> files = mesh_files(arguments);
    const std::vector<RigKey> steps =
        steps_of(posed.rig.armature, posed.pose, static_cast<int>(files.size()));
    for (std::size_t i = 0; i < files.size(); ++i) {
        write_output_text(files[i],
                          write_mesh_as(files[i],
                                        deform(posed.mesh, posed.rig.armature, posed.rig.weights,
                                               steps[i].motions, arguments.skinning),
                                        posed.mesh.triangles, common.command));
    }
}

void print_measures(const Arguments& arguments, const Posed& posed) {
    const int count = std::max(arguments.frames, 1);
    const std::vector<RigKey> steps = steps_of(posed.rig.armature, posed.pose, count);
    std::string text;
    if (count > 1) {
        text = "frame  seconds     volume  flipped  crossing  stretch99  farthest\n";
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::vector<DVec3> places = deform(posed.mesh, posed.rig.armature, posed.rig.weights,
                                                 steps[i].motions, arguments.skinning);
        const DeformMeasures measures =
            measure_deformation(posed.mesh, places, posed.rig.weights, steps[i].motions);
        text += count > 1 ? measures_row(i + 1, steps[i].seconds, measures)
                          : measures_text(posed.mesh, measures);
    }
    std::fputs(text.c_str(), stderr);
}

Image strip_of(const Arguments& arguments, const Posed& posed, gl::Context& context) {
    const PreparedSurface rest = prepare_surface(posed.mesh);
    std::vector<Frame> frames;
    for (const RigKey& step : steps_of(posed.rig.armature, posed.pose, arguments.strip_frames)) {
        const std::vector<DVec3> places = deform(posed.mesh, posed.rig.armature, posed.rig.weights,
                                                 step.motions, arguments.skinning);
        Frame& frame = frames.emplace_back();
        frame.surface = rest.surface;
        for (std::size_t v = 0; v < places.size(); ++v) {
            if (rest.surface_vertex[v] == kNone) continue;
            frame.surface.positions[rest.surface_vertex[v]] =
                rest.surface.world_from_model.to_world(places[v]);
        }
        derive_normals(frame.surface);
        frame.graph = deform_skeleton(posed.rig.graph, posed.rig.armature, step.motions);
    }
    return draw_strip(context, frames, arguments.picture);
}

Mesh mesh_of(const Demo& demo) {
    return parse_mesh(std::as_bytes(std::span(demo.model)), MeshFormat::Obj, demo.name);
}

// What a demo stands for, where nothing else is asked for.
Arguments with_demo(Arguments arguments, const Demo& demo) {
    if (!arguments.model.empty() || !arguments.pose.empty())
        throw UsageError("--demo brings its own model and pose");
    if (arguments.output.empty()) arguments.output = fmt::format("{}.glb", demo.name);
    if (arguments.strip.empty()) arguments.strip = fmt::format("{}.png", demo.name);
    if (!arguments.picture.view) arguments.picture.view = parse_view(demo.view);
    return arguments;
}

ExitCode deform_model(const Arguments& given, const Common& common) {
    const auto demo = std::find_if(kDemos.begin(), kDemos.end(),
                                   [&](const Demo& d) { return given.demo == d.name; });
    const bool is_demo = demo != kDemos.end();
    const Arguments arguments = is_demo ? with_demo(given, *demo) : given;
    if (arguments.model == "-" && arguments.pose == "-")
        throw UsageError("the model and the pose cannot both come from standard input");
    if (arguments.output.empty() ||
        (!is_demo && (arguments.model.empty() || arguments.pose.empty())))
        throw UsageError("deform needs a model, --pose and --output, or --demo");
    std::vector<std::string> outputs = is_animation(arguments.output)
                                           ? std::vector<std::string>{arguments.output}
                                           : mesh_files(arguments);
    outputs.push_back(arguments.strip);
    check_outputs(arguments.model, outputs);
    check_outputs(arguments.pose, outputs);
    check_extension(arguments.strip, ".png");

    const std::string pose_text(is_demo ? demo->pose
                                        : read_input_file(arguments.pose, "a pose (JSON)").text());
    std::unique_ptr<gl::Context> picture_context;
    if (!arguments.strip.empty()) picture_context = open_picture_context();
    Posed posed;
    posed.mesh = is_demo ? mesh_of(*demo) : read_mesh(arguments.model, common.reading);
    posed.rig = rig_model(posed.mesh, arguments.rig);
    posed.pose =
        read_pose(pose_text, is_demo ? "the demo's pose" : arguments.pose, posed.rig.armature);
    if (is_animation(arguments.output)) {
        write_animation(arguments, posed, common);
    } else {
        write_meshes(arguments, posed, common);
    }
    if (picture_context) {
        write_png(arguments.strip, strip_of(arguments, posed, *picture_context),
                  fmt::format("zskel: {}, posed", posed.mesh.name));
    }
    if (common.verbosity >= 0) print_measures(arguments, posed);
    return ExitCode::Ok;
}

}  // namespace

void add_deform_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand("deform", "Pose a mesh by the branches of its skeleton");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model)->required(false);
    command->add_option(
        "--pose", arguments->pose,
        "JSON: {\"moves\": [{\"branch\": 3, \"bend\": 90, \"axis\": [0, 0, 1]}, ...]}; "
        "branch: its number in the skeleton's JSON, or bone: a name, or near: a "
        "point; turn, bend and twist in degrees, stretch as a factor; begin and end in seconds");
    command->add_option("-o,--output", arguments->output,
                        "OBJ or PLY: the mesh in that pose, - writes standard output; GLB: the "
                        "bound mesh with an animation that goes there");
    command
        ->add_option("--frames", arguments->frames,
                     "Write the way there: this many files, OUT_0001 and on, or this many keys of "
                     "the animation [30 a second]")
        ->check(CLI::Range(1, 9999));
    command
        ->add_option("--demo", arguments->demo,
                     "In place of a model and a pose: hand, whose fingers curl one after the other "
                     "(the paper's Figure 5); writes hand.glb and hand.png")
        ->check(CLI::IsMember({"hand"}));
    command->add_option("--strip", arguments->strip, "Draw poses on the way side by side (PNG)");
    command->add_option("--strip-frames", arguments->strip_frames, "How many")
        ->capture_default_str()
        ->check(CLI::Range(1, 20));
    add_view_option(*command, arguments->picture);
    command
        ->add_option_function<std::string>(
            "--skinning",
            [arguments](const std::string& name) {
                arguments->skinning =
                    name == "linear" ? Skinning::Linear : Skinning::DualQuaternion;
            },
            "dual: dual quaternions, which keep a bent limb's girth; linear: as most engines, and "
            "viewers of GLB [dual]")
        ->check(CLI::IsMember({"dual", "linear"}));
    add_rig_options(*command, arguments->rig);
    command->footer(
        "Examples:\n  zskel deform hand.obj --pose fist.json -o fist.obj\n"
        "  zskel deform hand.obj --pose fist.json --frames 24 -o fist.obj\n"
        "  zskel deform hand.obj --pose fist.json -o fist.glb\n"
        "  zskel deform --demo hand");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return deform_model(*arguments, common); };
    });
}

}  // namespace zskel::cli
