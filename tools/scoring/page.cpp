#include "scoring/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scoring/base64.h"
#include "scoring/page_parts.h"
#include "zskel/io/markup.h"

namespace zskel::scoring {
namespace {

constexpr std::size_t kTinted = 3;  // of the worst values of a column

// The values of a column that are tinted, the worst first: worse than the median, and worst.
std::vector<double> worst_of(const Column& column, const std::vector<Row>& rows) {
    const auto middle = median_of(column, rows);
    if (column.worse == Worse::Neither || column.limit || !middle) return {};
    const double sign = column.worse == Worse::Higher ? 1.0 : -1.0;
    std::vector<double> values;
    for (const Row& row : rows) {
        const auto value = row.score ? column.value(*row.score) : std::nullopt;
        if (value && sign * *value > sign * *middle) values.push_back(*value);
    }
    std::sort(values.begin(), values.end(),
              [=](double l, double r) { return sign * l > sign * r; });
    values.erase(std::unique(values.begin(), values.end()), values.end());
    values.resize(std::min(values.size(), kTinted));
    return values;
}

// Whether a column is the first of its group, which stands a little apart.
bool is_first(std::size_t i) {
    return i == 0 || columns()[i].group != columns()[i - 1].group;
}

std::string heading() {
    std::string groups = "<th></th>";
    std::string titles = "<th data-order=\"1\">model</th>";
    for (std::size_t i = 0; i < columns().size(); ++i) {
        const Column& column = columns()[i];
        titles += fmt::format("<th{} title=\"{}\">{}</th>", is_first(i) ? " class=\"first\"" : "",
                              escaped_markup(column.legend), column.title);
        if (!is_first(i)) continue;
        const auto width = std::count_if(columns().begin(), columns().end(),
                                         [&](const Column& c) { return c.group == column.group; });
        groups += fmt::format("<th class=\"first{}\" colspan=\"{}\">{}</th>",
                              width > 1 ? " group" : "", width, column.group);
    }
    return fmt::format("<thead><tr>{}</tr>\n<tr>{}</tr></thead>\n", groups, titles);
}

// The class names of a cell.
std::string classes(std::size_t i, std::optional<double> value, const std::vector<double>& worst) {
    std::string out = is_first(i) ? "first" : "";
    if (is_beyond(columns()[i], value)) out += " bad";
    const auto rank = value ? std::find(worst.begin(), worst.end(), *value) : worst.end();
    if (rank != worst.end()) out += fmt::format(" worst{}", rank - worst.begin() + 1);
    return out;
}

std::string name_cell(const Row& row) {
    const std::string name = escaped_markup(row.name);
    return fmt::format("<td data-v=\"{0}\"><a href=\"#{0}\">{0}</a></td>", name);
}

std::string table_row(const Row& row, const std::vector<std::vector<double>>& worst) {
    std::string cells = name_cell(row);
    if (!row.score) {
        return fmt::format("<tr>{}<td class=\"failure\" colspan=\"{}\">failed: {}</td></tr>\n",
                           cells, columns().size(), escaped_markup(row.failure));
    }
    for (std::size_t i = 0; i < columns().size(); ++i) {
        const Column& column = columns()[i];
        const auto value = column.value(*row.score);
        cells += fmt::format("<td class=\"{}\" data-v=\"{}\">{}</td>", classes(i, value, worst[i]),
                             value ? fmt::to_string(*value) : "", shown(column, *row.score));
    }
    return fmt::format("<tr>{}</tr>\n", cells);
}

std::string medians(const std::vector<Row>& rows) {
    std::string cells = "<td>median</td>";
    for (std::size_t i = 0; i < columns().size(); ++i) {
        const Column& column = columns()[i];
        // Half a wrong topology means nothing.
        const bool is_count = column.key == "topology_wrong";
        cells += fmt::format("<td class=\"{}\">{}</td>", is_first(i) ? "first" : "",
                             is_count ? "" : shown(column, median_of(column, rows)));
    }
    return fmt::format("<tfoot><tr>{}</tr></tfoot>\n", cells);
}

std::string table(const std::vector<Row>& rows) {
    std::vector<std::vector<double>> worst;
    for (const Column& column : columns()) worst.push_back(worst_of(column, rows));
    std::string body;
    for (const Row& row : rows) body += table_row(row, worst);
    return fmt::format("<table>\n{}<tbody>\n{}</tbody>\n{}</table>\n", heading(), body,
                       medians(rows));
}

std::string tile(const char* what, std::size_t count, bool is_wrong) {
    return fmt::format("<div class=\"tile{}\"><b>{}</b><span>{}</span></div>\n",
                       is_wrong ? " bad" : "", count, what);
}

std::string tiles(const std::vector<Row>& rows) {
    const Totals t = totals_of(rows);
    std::string out = tile(rows.size() == 1 ? "model" : "models", rows.size(), false);
    const std::pair<const char*, std::size_t> counts[] = {{"failed", t.failed},
                                                          {"with wrong topology", t.topology_wrong},
                                                          {"leave the model", t.not_inside},
                                                          {"spurs", t.spurs},
                                                          {"limbs missed", t.missed},
                                                          {"limbs invented", t.invented}};
    for (const auto& [what, count] : counts) out += tile(what, count, count > 0);
    return fmt::format("<div class=\"tiles\">\n{}</div>\n", out);
}

// "left ear, tail (2)": each name once.
std::string counted(const std::vector<std::string>& names) {
    std::map<std::string, std::size_t> counts;
    for (const std::string& name : names) ++counts[name];
    std::vector<std::string> parts;
    for (const auto& [name, count] : counts)
        parts.push_back(escaped_markup(name) + (count > 1 ? fmt::format(" ({})", count) : ""));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string limbs_text(const Score& score) {
    if (!score.truth) return "<p>no true skeleton is known</p>";
    const TruthScore& truth = *score.truth;
    std::string out;
    if (!truth.missed.empty())
        out += fmt::format("<p class=\"wrong\">missed: {}</p>", counted(truth.missed));
    if (!truth.invented.empty())
        out += fmt::format("<p class=\"wrong\">invented, by: {}</p>", counted(truth.invented));
    if (!out.empty()) return out;
    return fmt::format(
        "<p>{} found, nothing invented</p>",
        truth.limbs == 1 ? "the one limb" : fmt::format("all {} limbs", truth.limbs));
}

std::string card(const Row& row) {
    const std::string name = escaped_markup(row.name);
    const std::string image =
        row.picture.empty() ? ""
                            : fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
                                          name, base64(row.picture));
    const std::string text =
        row.score ? limbs_text(*row.score)
                  : fmt::format("<p class=\"wrong\">failed: {}</p>", escaped_markup(row.failure));
    return fmt::format("<div class=\"card\" id=\"{0}\">\n{1}<div><b>{0}</b>{2}</div></div>\n", name,
                       image, text);
}

std::string legend() {
    std::string out;
    for (std::size_t i = 0; i < columns().size(); ++i) {
        const Column& column = columns()[i];
        out += fmt::format("<section><dt>{}: {}</dt><dd>{}</dd></section>\n", column.group,
                           column.title, escaped_markup(column.legend));
    }
    return fmt::format("<h2>What the measures say</h2>\n<dl>\n{}</dl>\n", out);
}

constexpr const char* kNote =
    "<p class=\"note\">Lengths are in diagonals of the model's bounding box. "
    "<span class=\"swatch bad\">Red</span> fails the model; "
    "<span class=\"swatch worst1\">amber</span> marks the three worst values of a column. "
    "A click on a heading sorts.</p>\n";

}  // namespace

std::string page_html(const std::vector<Row>& rows, const std::string& subtitle,
                      const std::string& no_picture) {
    std::string cards;
    for (const Row& row : rows) cards += card(row);
    const std::string missing =
        no_picture.empty() ? ""
                           : fmt::format("<p class=\"note\">There are no pictures: {}</p>\n",
                                         escaped_markup(no_picture));
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<title>Skeleton scores</title>\n<style>{}</style></head>\n<body>\n"
        "<h1>Skeleton scores</h1>\n<p class=\"sub\"><code>{}</code></p>\n{}{}{}"
        "<h2>The models</h2>\n{}<div class=\"cards\">\n{}</div>\n{}<script>{}</script>\n"
        "</body></html>\n",
        kPageStyle, escaped_markup(subtitle), tiles(rows), table(rows), kNote, missing, cards,
        legend(), kPageScript);
}

}  // namespace zskel::scoring
