// Surfaces by formula, as JSON; the form is told in formats.h.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "zskel/core/error.h"
#include "zskel/io/json_place.h"
#include "zskel/mesh/formats.h"
#include "zskel/mesh/parametric.h"

namespace zskel {
namespace {

constexpr std::uint32_t kMostDegree = 25;
constexpr double kLeastExponent = 0.1;
constexpr double kMostExponent = 4.0;

double positive(const JsonPlace& place) {
    const double value = place.number();
    if (!(value > 0.0)) place.fail("a number above 0");
    return value;
}

void check_size(const JsonPlace& place, std::size_t expected) {
    if (place.array_size() != expected) place.fail(fmt::format("an array of {}", expected));
}

// Rows of points, all as long.
JsonPlace row_of(const JsonPlace& points, std::size_t row) {
    JsonPlace place = points.at(row);
    if (place.array_size() != points.at(std::size_t{0}).array_size() || place.array_size() < 2)
        place.fail("a row as long as the first, of two points or more");
    return place;
}

PatchGroup read_bezier(const JsonPlace& entry) {
    const JsonPlace patches = entry.at("patches");
    PatchGroup group;
    for (std::size_t p = 0; p < patches.array_size(); ++p) {
        const JsonPlace points = patches.at(p);
        if (points.array_size() < 2 || points.array_size() > kMostDegree + 1)
            points.fail(fmt::format("2 to {} rows of points", kMostDegree + 1));
        std::vector<std::vector<DVec3>> rows(points.array_size());
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const JsonPlace row = row_of(points, r);
            if (row.array_size() > kMostDegree + 1)
                row.fail(fmt::format("at most {} points", kMostDegree + 1));
            for (std::size_t c = 0; c < row.array_size(); ++c) rows[r].push_back(row.at(c).point());
        }
        group.push_back(bezier_patch(std::move(rows)));
    }
    return group;
}

std::vector<double> read_knots(const JsonPlace& place, std::size_t points, int degree) {
    if (points <= static_cast<std::size_t>(degree))
        place.fail(fmt::format("possible: degree {} needs more than {} points", degree, points));
    check_size(place, points + static_cast<std::size_t>(degree) + 1);
    std::vector<double> knots;
    for (std::size_t k = 0; k < place.array_size(); ++k) {
        knots.push_back(place.at(k).number());
        if (k > 0 && knots[k] < knots[k - 1]) place.at(k).fail("as large as the knot before it");
    }
    const auto first = static_cast<std::size_t>(degree);
    if (!(knots[points] > knots[first])) place.fail("knots with a span between them");
    return knots;
}

int read_degree(const JsonPlace& place) {
    const std::uint32_t degree = place.count();
    if (degree < 1 || degree > kMostDegree) place.fail(fmt::format("from 1 to {}", kMostDegree));
    return static_cast<int>(degree);
}

PatchGroup read_nurbs(const JsonPlace& entry) {
    Nurbs nurbs;
    const JsonPlace points = entry.at("points");
    if (points.array_size() < 2) points.fail("two rows of points or more");
    for (std::size_t r = 0; r < points.array_size(); ++r) {
        const JsonPlace row = row_of(points, r);
        std::vector<glm::dvec4>& out = nurbs.points.emplace_back();
        for (std::size_t c = 0; c < row.array_size(); ++c) {
            const JsonPlace point = row.at(c);
            check_size(point, 4);
            out.emplace_back(point.at(std::size_t{0}).number(), point.at(1).number(),
                             point.at(2).number(), positive(point.at(3)));
        }
    }
    const JsonPlace degrees = entry.at("degrees");
    check_size(degrees, 2);
    nurbs.degree_u = read_degree(degrees.at(std::size_t{0}));
    nurbs.degree_v = read_degree(degrees.at(1));
    const JsonPlace knots = entry.at("knots");
    check_size(knots, 2);
    nurbs.knots_u =
        read_knots(knots.at(std::size_t{0}), nurbs.points.front().size(), nurbs.degree_u);
    nurbs.knots_v = read_knots(knots.at(1), nurbs.points.size(), nurbs.degree_v);
    return nurbs_patches(nurbs);
}

double read_exponent(const JsonPlace& place) {
    const double value = place.number();
    if (!(value >= kLeastExponent && value <= kMostExponent))
        place.fail(fmt::format("from {} to {}", kLeastExponent, kMostExponent));
    return value;
}

PatchGroup read_superquadric(const JsonPlace& entry) {
    Superquadric out;
    const JsonPlace radii = entry.at("radii");
    out.radii = radii.point();
    for (std::size_t k = 0; k < 3; ++k) positive(radii.at(k));
    const JsonPlace exponents = entry.at("exponents");
    check_size(exponents, 2);
    out.exponent_1 = read_exponent(exponents.at(std::size_t{0}));
    out.exponent_2 = read_exponent(exponents.at(1));
    if (entry.has("center")) out.center = entry.at("center").point();
    if (entry.has("turn")) {
        out.turn = glm::radians(entry.at("turn").number());
        out.axis = entry.at("axis").point();
        if (!(glm::length(out.axis) > 0.0 && std::isfinite(glm::length(out.axis))))
            entry.at("axis").fail("a direction");
    }
    return superquadric_patches(out);
}

PatchGroup read_surface(const JsonPlace& entry) {
    const JsonPlace type = entry.at("type");
    if (type.value() == "bezier") return read_bezier(entry);
    if (type.value() == "nurbs") return read_nurbs(entry);
    if (type.value() == "superquadric") return read_superquadric(entry);
    type.fail("bezier, nurbs or superquadric");
}

}  // namespace

Mesh read_surfaces(std::string_view bytes, std::string_view name, const ReadOptions& options) {
    const nlohmann::json data = parse_json(bytes, std::string(name));
    const JsonPlace surfaces = JsonPlace(data, std::string(name)).at("surfaces");
    std::vector<PatchGroup> groups;
    for (std::size_t i = 0; i < surfaces.array_size(); ++i)
        groups.push_back(read_surface(surfaces.at(i)));
    return tessellate(groups, options.chord_error, std::string(name), options.max_faces);
}

}  // namespace zskel
