#include "extraction_options.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "command.h"

namespace zskel::cli {
namespace {

std::size_t parse_seeds(const std::string& text) {
    if (text == "all") return std::numeric_limits<std::size_t>::max();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1) {
        throw UsageError(fmt::format("--seeds {}: give a number from 1, or all", text));
    }
    return value;
}

// Options that only one method has; given with another they would mean nothing, which is an error.
void add_method_options(CLI::App& command, ExtractionOptions& options) {
    PaperMethodOptions& paper = options.extract.paper;
    NewtonMethodOptions& newton = options.extract.newton;
    options.newton_only = {
        command
            .add_option_function<std::string>(
                "--seeds",
                [&newton](const std::string& text) {
                    newton.spread.min_seeds = newton.spread.max_seeds = parse_seeds(text);
                },
                "How many seeds are spread over the surface, or all: one a vertex [from 300, as "
                "many as the thickness around them asks for]")
            ->type_name("N|all")
            ->group(kNewtonGroup),
        command
            .add_option(
                "--detail", newton.limbs.detail,
                "How far a limb must stick out to be kept: below 1 more of them, above 1 fewer")
            ->capture_default_str()
            ->check(number_in(0.01, 100.0))
            ->group(kNewtonGroup),
        command
            .add_option(
                "--min-handle", newton.min_handle_model,
                "Handles of a smaller radius get no cycle; they are counted and listed. The "
                "radius, in the model's units, is the length over 2 pi of the shortest loop "
                "round the handle or round its hole. 0: every handle gets its cycle")
            ->type_name("R")
            ->capture_default_str()
            ->check(length_or_zero())
            ->group(kNewtonGroup),
        command
            .add_option("--resample", newton.resample_model,
                        "Spread the nodes evenly, at most this far apart, in the model's units; "
                        "nearer where the straight way would leave the solid; 0: by the radius")
            ->type_name("LENGTH")
            ->capture_default_str()
            ->check(length_or_zero())
            ->group(kNewtonGroup),
        command
            .add_flag_callback(
                "--active-contour", [&newton] { newton.refine = active_contour(); },
                "Keep to the shape's own bends: more centring, less smoothing of branches")
            ->group(kNewtonGroup),
    };
    options.paper_only = {
        command.add_option("--step", paper.steps.step_world, "Length of a step, in the unit cube")
            ->capture_default_str()
            ->check(positive_length())
            ->group(kPaperGroup),
        command
            .add_option("--max-steps", paper.steps.max_steps, "Steps after which a seed is stopped")
            ->capture_default_str()
            ->check(CLI::Range(1, 1 << 30))
            ->group(kPaperGroup),
        command
            .add_option("--offset", paper.seeds.offset_world,
                        "How far inside the surface seeds start, in the unit cube")
            ->capture_default_str()
            ->check(positive_length())
            ->group(kPaperGroup),
        command
            .add_option("--cluster", paper.clusters.range_world,
                        "Range within which end points become one node, in the unit cube")
            ->capture_default_str()
            ->check(length_or_zero())
            ->group(kPaperGroup),
    };
}

}  // namespace

void add_extraction_options(CLI::App& command, ExtractionOptions& options) {
    command
        .add_option_function<std::string>(
            "--method",
            [&options](const std::string& name) { options.extract.method = parse_method(name); },
            "newton: Newton steps, right topology, refined; paper: the published method [newton]")
        ->type_name("NAME");
    add_backend_options(command, options.backend);
    add_repair_options(command, options.extract);
    add_method_options(command, options);
}

void add_repair_options(CLI::App& command, ExtractOptions& options) {
    constexpr const char* kGroup = "Repairs";
    command
        .add_flag_callback(
            "--no-repair", [&options] { options.repair.is_allowed = false; },
            "Refuse models that need any, with exit code 3")
        ->group(kGroup);
    command
        .add_option("--weld-tolerance", options.repair.weld_tolerance_diagonals,
                    "How far apart vertices on boundary edges may be to be welded, in diagonals of "
                    "the bounding box; 0: only equal ones are")
        ->capture_default_str()
        ->check(length_or_zero())
        ->group(kGroup);
    command
        .add_flag_callback(
            "--no-caps", [&options] { options.repair.has_caps = false; },
            "Leave openings open: what is seen through them does not repel")
        ->group(kGroup);
    CLI::Option* join =
        command
            .add_flag_callback(
                "--join", [&options] { options.join = options.join.value_or(JoinOptions{}); },
                "Unite parts that overlap or touch, by their winding number")
            ->group(kGroup);
    command
        .add_option_function<double>(
            "--join-voxel", [&options](double side) { options.join = JoinOptions{side}; },
            "Side of the cubes that the union is sampled in, in the model's units [the longest "
            "side / 160]")
        ->type_name("LENGTH")
        ->check(positive_length())
        ->needs(join)
        ->group(kGroup);
}

void check_method_options(const ExtractionOptions& options) {
    const bool is_paper = options.extract.method == Method::Paper;
    for (const CLI::Option* option : is_paper ? options.newton_only : options.paper_only) {
        if (option->count() == 0) continue;
        throw UsageError(fmt::format("{} goes with --method {}, not with {}", option->get_name(),
                                     is_paper ? "newton" : "paper",
                                     name_of(options.extract.method)));
    }
}

}  // namespace zskel::cli
