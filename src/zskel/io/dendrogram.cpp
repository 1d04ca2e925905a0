// Average linkage (Sokal and Michener 1958): the two nearest groups become one, whose distances are
// the means of theirs, weighted by their sizes.
#include "zskel/io/dendrogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "zskel/core/error.h"
#include "zskel/io/markup.h"

namespace zskel {
namespace {

constexpr std::size_t kMostNames = 4000;
constexpr double kRow = 16.0;  // pixels
constexpr double kTree = 480.0;
constexpr double kMargin = 12.0;
constexpr double kLetter = 7.0;

struct Group {
    std::vector<std::size_t> members;  // in the order of the picture's rows
    std::size_t left = 0;
    std::size_t right = 0;
    double height = 0.0;  // distance of its two parts
};

// Leaves first, then a group for every join.
std::vector<Group> linked(std::vector<std::vector<double>> distances) {
    const std::size_t count = distances.size();
    std::vector<Group> groups(count);
    std::vector<std::size_t> group_at(count);  // of every row of `distances` that is in use
    for (std::size_t i = 0; i < count; ++i) {
        groups[i].members = {i};
        group_at[i] = i;
    }
    std::vector<std::size_t> rows = group_at;
    while (rows.size() > 1) {
        std::pair<std::size_t, std::size_t> best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (std::size_t j = i + 1; j < rows.size(); ++j) {
                if (distances[rows[i]][rows[j]] < least) {
                    least = distances[rows[i]][rows[j]];
                    best = {i, j};
                }
            }
        }
        const std::size_t a = rows[best.first];
        const std::size_t b = rows[best.second];
        Group joined{groups[group_at[a]].members, group_at[a], group_at[b], least};
        const std::vector<std::size_t>& others = groups[group_at[b]].members;
        const auto of_a = static_cast<double>(joined.members.size());
        const auto of_b = static_cast<double>(others.size());
        joined.members.insert(joined.members.end(), others.begin(), others.end());
        for (const std::size_t row : rows) {
            distances[a][row] = distances[row][a] =
                (of_a * distances[a][row] + of_b * distances[b][row]) / (of_a + of_b);
        }
        group_at[a] = groups.size();
        groups.push_back(std::move(joined));
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(best.second));
    }
    return groups;
}

}  // namespace

std::string dendrogram_svg(const std::vector<std::string>& names,
                           const std::vector<std::vector<double>>& distances) {
    if (names.empty() || names.size() > kMostNames) {
        throw UsageError(
            fmt::format("a tree of {} names; expected 1 to {}", names.size(), kMostNames));
    }
    const std::vector<Group> groups = linked(distances);
    const double farthest = std::max(groups.back().height, std::numeric_limits<double>::min());
    std::size_t longest = 0;
    for (const std::string& name : names) longest = std::max(longest, name.size());
    const double width = kTree + 3.0 * kMargin + kLetter * static_cast<double>(longest);
    const double height = kRow * static_cast<double>(names.size()) + 2.0 * kMargin;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<g font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n",
        width, height);
    // Where each group's line ends on the right of its join.
    std::vector<double> y(groups.size());
    std::vector<double> x(groups.size());
    for (std::size_t row = 0; row < names.size(); ++row) {
        const std::size_t leaf = groups.back().members[row];
        x[leaf] = kMargin + kTree;
        y[leaf] = kMargin + kRow * (static_cast<double>(row) + 0.5);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x[leaf] + 6.0,
                           y[leaf] + 4.0, escaped_markup(names[leaf]));
    }
    out += "</g>\n<g fill=\"none\" stroke=\"#345\">\n";
    for (std::size_t g = names.size(); g < groups.size(); ++g) {
        const Group& group = groups[g];
        x[g] = kMargin + kTree * (1.0 - group.height / farthest);
        y[g] = 0.5 * (y[group.left] + y[group.right]);
        out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}V{:.1f}H{:.1f}\"/>\n", x[group.left],
                           y[group.left], x[g], y[group.right], x[group.right]);
    }
    return out + "</g>\n</svg>\n";
}

}  // namespace zskel
