// zskel compare: one backend's cube maps against another's, on eyes along the seeds' paths.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "zskel/compare.h"
#include "zskel/mesh/read_mesh.h"

namespace zskel::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string model;
    int eyes = 48;
    bool as_json = false;
    std::string method;
    BackendOptions tested;
    BackendKind reference = BackendKind::Ray;
};

Json to_json(const Difference& d) {
    return {{"median", d.median}, {"p999", d.p999}, {"worst", d.worst}, {"texels", d.count}};
}

Json to_json(const DVec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json to_json(const SourceComparison& c, const ComparisonBounds& bounds) {
    return {{"eyes", c.eyes},
            {"texels", c.texels},
            {"relative_distance",
             {{"inner", to_json(c.inner)},
              {"silhouette", to_json(c.silhouette)},
              {"all", to_json(c.all)}}},
            {"worst_inner",
             {{"eye", to_json(c.worst_inner.eye_model)},
              {"direction", to_json(c.worst_inner.direction)},
              {"distance_world", c.worst_inner.distance},
              {"reference_world", c.worst_inner.reference}}},
            {"one_sided_texels", c.one_sided},
            {"id_agreement", {{"inner", c.id_agreement_inner}, {"all", c.id_agreement_all}}},
            {"force_error",
             {{"median", c.force_error_median},
              {"p95", c.force_error_p95},
              {"worst", c.force_error_worst}}},
            {"jacobian_error",
             {{"median", c.jacobian_error_median},
              {"p95", c.jacobian_error_p95},
              {"worst", c.jacobian_error_worst},
              {"eyes", c.jacobians}}},
            {"force_angle_deg",
             {{"median", c.angle_median_deg}, {"worst", c.angle_worst_deg}, {"eyes", c.angles}}},
            {"bounds",
             {{"texel_median", bounds.texel_median},
              {"inner_p999", bounds.inner_p999},
              {"force_p95", bounds.force_p95},
              {"jacobian_p95", bounds.jacobian_p95},
              {"angle_median_deg", bounds.angle_median_deg}}},
            {"within_bounds", is_within(c, bounds)}};
}

std::string to_text(const SourceComparison& c, const ComparisonBounds& bounds) {
    const auto line = [](const char* name, const Difference& d) {
        return fmt::format("  {:<12} {:>9} texels   median {:.2e}   99.9 % {:.2e}   worst {:.2e}\n",
                           name, d.count, d.median, d.p999, d.worst);
    };
    std::string text =
        fmt::format("{} eyes, {} texels; relative difference of distances:\n", c.eyes, c.texels);
    text += line("inner", c.inner) + line("silhouette", c.silhouette) + line("all", c.all);
    text += fmt::format(
        "  worst inner: eye {:.6g} {:.6g} {:.6g}, direction {:.4f} {:.4f} {:.4f}: {:.6g} against "
        "{:.6g}\n",
        c.worst_inner.eye_model.x, c.worst_inner.eye_model.y, c.worst_inner.eye_model.z,
        c.worst_inner.direction.x, c.worst_inner.direction.y, c.worst_inner.direction.z,
        c.worst_inner.distance, c.worst_inner.reference);
    text += fmt::format("texels that only one of the two hits: {}\n", c.one_sided);
    text += fmt::format("same triangle: {:.4f} % of inner texels, {:.4f} % of all\n",
                        100 * c.id_agreement_inner, 100 * c.id_agreement_all);
    text += fmt::format("force, over the mean of 1/r: median {:.2e}   95 % {:.2e}   worst {:.2e}\n",
                        c.force_error_median, c.force_error_p95, c.force_error_worst);
    text += c.jacobians == 0
                ? "Jacobian: not compared, since no eye sees the same triangles in both\n"
                : fmt::format(
                      "Jacobian, at the {} eyes that see the same triangles: median {:.2e}   95 % "
                      "{:.2e}   worst {:.2e}\n",
                      c.jacobians, c.jacobian_error_median, c.jacobian_error_p95,
                      c.jacobian_error_worst);
    text += fmt::format(
        "angle, at the {} eyes where it means something: median {:.4f}   worst {:.4f} degrees\n",
        c.angles, c.angle_median_deg, c.angle_worst_deg);
    text += fmt::format(
        "{} (bounds: texel median {:.0e}, 99.9 % of inner texels {:.0e}, 95 % of forces {:.0e}, "
        "of Jacobians {:.0e}, median angle {} degrees)\n",
        is_within(c, bounds) ? "within bounds" : "NOT within bounds", bounds.texel_median,
        bounds.inner_p999, bounds.force_p95, bounds.jacobian_p95, bounds.angle_median_deg);
    return text;
}

Json to_json(const SkeletonComparison& c, const SkeletonBounds& bounds) {
    return {{"seeds", c.seeds},
            {"parted_seeds", c.parted.size()},
            {"parted_vertices", c.parted},
            {"nodes", {{"tested", c.nodes_tested}, {"reference", c.nodes_reference}}},
            {"mean_distance_diagonals", c.mean_distance_diagonals},
            {"bounds",
             {{"parted_share", bounds.parted_share},
              {"node_share", bounds.node_share},
              {"mean_distance_diagonals", bounds.mean_distance_diagonals}}},
            {"within_bounds", is_within(c, bounds)}};
}

std::string to_text(const SkeletonComparison& c, const SkeletonBounds& bounds) {
    std::string text = fmt::format(
        "skeletons: {} and {} nodes, {:.5f} of the diagonal apart in the mean\n"
        "seeds that end more than two steps apart: {} of {}",
        c.nodes_tested, c.nodes_reference, c.mean_distance_diagonals, c.parted.size(), c.seeds);
    constexpr std::size_t kMostListed = 20;  // --json has them all
    for (std::size_t i = 0; i < std::min(c.parted.size(), kMostListed); ++i)
        text += fmt::format("{}{}", i == 0 ? ", at vertices " : ", ", c.parted[i]);
    if (c.parted.size() > kMostListed)
        text += fmt::format(" and {} more", c.parted.size() - kMostListed);
    return text + fmt::format("\n{} (bounds: {:.0f} % of seeds, {:.0f} % of nodes, distance {})\n",
                              is_within(c, bounds) ? "within bounds" : "NOT within bounds",
                              100 * bounds.parted_share, 100 * bounds.node_share,
                              bounds.mean_distance_diagonals);
}

// The whole method with both backends, end points held against each other at two of the paper's
// steps.
SkeletonComparison compare_extracts(const Mesh& mesh, const ExtractOptions& options,
                                    Backend& tested, Backend& reference) {
    const ExtractResult a = extract_skeleton(mesh, options, tested);
    const ExtractResult b = extract_skeleton(mesh, options, reference);
    const double two_steps = 2.0 * options.paper.steps.step_world;
    return compare_skeletons(a, b, b.surface.world_from_model.length_to_model(two_steps));
}

ExitCode compare(const Arguments& arguments, const Common& common) {
    const Mesh mesh = read_mesh(arguments.model, common.reading);
    ExtractOptions options;
    BackendOptions tested_options = arguments.tested;
    if (!arguments.method.empty()) {
        options.method = parse_method(arguments.method);
        tested_options = backend_options_for(mesh, options, tested_options);
    }
    const auto tested = open_backend(tested_options);
    BackendOptions reference_options;
    reference_options.kind = arguments.reference;
    reference_options.exact = true;  // it is taken for the truth
    reference_options.face_px = tested_options.face_px;
    const auto reference = open_backend(reference_options);
    Json out{{"model", arguments.model},
             {"tested", tested->info().name},
             {"reference", reference->info().name}};
    std::string text = fmt::format("{}: {} against {}\n", arguments.model, tested->info().name,
                                   reference->info().name);
    bool is_fine = false;
    if (arguments.method.empty()) {
        const SourceComparison c = compare_backends(mesh, *tested, *reference, arguments.eyes, {});
        const ComparisonBounds bounds = bounds_of(tested->info(), mesh.triangles.size());
        is_fine = is_within(c, bounds);
        out.update(to_json(c, bounds));
        text += to_text(c, bounds);
    } else {
        const SkeletonComparison c = compare_extracts(mesh, options, *tested, *reference);
        const SkeletonBounds bounds = skeleton_bounds_of(tested->info(), mesh.triangles.size());
        is_fine = is_within(c, bounds);
        out.update(to_json(c, bounds));
        text += to_text(c, bounds);
    }
    print(arguments.as_json ? out.dump(2) + "\n" : text);
    return is_fine ? ExitCode::Ok : ExitCode::Check;
}

}  // namespace

void add_compare_command(CLI::App& app, const Common& common, Run& run) {
    CLI::App* command = app.add_subcommand(
        "compare", "Measure one backend's cube maps against another's; exit 6 when out of bounds");
    auto arguments = std::make_shared<Arguments>();
    add_model_argument(*command, arguments->model);
    command
        ->add_option("--eyes", arguments->eyes,
                     "About this many eyes: starts, mid-paths and ends of seeds")
        ->capture_default_str()
        ->check(CLI::Range(1, 1 << 20));
    command
        ->add_option("--method", arguments->method,
                     "Compare the skeletons by this method instead: seeds, nodes, distance")
        ->check(CLI::IsMember({"newton", "paper"}));
    command->add_flag("--json", arguments->as_json, "Print JSON");
    add_backend_options(*command, arguments->tested);
    command
        ->add_option_function<std::string>(
            "--against",
            [arguments](const std::string& name) { arguments->reference = parse_backend(name); },
            "The backend that is taken for the truth [ray]")
        ->type_name("NAME");
    command->footer(
        "Examples:\n  zskel compare horse.obj --backend cpu --eyes 300\n"
        "  zskel compare horse.obj --backend osmesa --face-px 32 --json\n"
        "  zskel compare horse.obj --method paper --backend gl");
    command->callback([&run, &common, arguments] {
        run = [&common, arguments] { return compare(*arguments, common); };
    });
}

}  // namespace zskel::cli
