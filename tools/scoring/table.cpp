#include "scoring/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scoring/numbers.h"

namespace zskel::scoring {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(std::optional<double> value) {
    return value ? Json(*value) : Json();
}

Json to_json(const Row& row) {
    Json out{{"model", row.name}, {"failure", row.failure.empty() ? Json() : Json(row.failure)}};
    if (!row.score) return out;
    const Score& score = *row.score;
    for (const Column& column : columns()) out[column.key] = to_json(column.value(score));
    out["components"] = score.topology.components;
    out["cycles"] = score.topology.cycles;
    out["expected_components"] = score.expected_components;
    out["expected_cycles"] = score.expected_cycles ? Json(*score.expected_cycles) : Json();
    out["limbs"] = score.truth ? Json(score.truth->limbs) : Json();
    out["missed_limbs"] = score.truth ? Json(score.truth->missed) : Json();
    out["invented_limbs"] = score.truth ? Json(score.truth->invented) : Json();
    return out;
}

Json to_json(const Totals& totals) {
    return {{"failed", totals.failed},         {"topology_wrong", totals.topology_wrong},
            {"not_inside", totals.not_inside}, {"spurs", totals.spurs},
            {"missed", totals.missed},         {"invented", totals.invented}};
}

// The name, then a cell a column.
std::vector<std::string> cells_of(const Row& row) {
    std::vector<std::string> cells{row.name};
    if (!row.score) {
        cells.push_back("failed: " + row.failure);
        return cells;
    }
    for (const Column& column : columns()) cells.push_back(shown(column, *row.score));
    return cells;
}

std::string aligned(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths(columns().size() + 1, 0);
    for (const auto& cells : lines) {
        if (cells.size() != widths.size()) continue;  // a failure takes the width it needs
        for (std::size_t i = 0; i < cells.size(); ++i)
            widths[i] = std::max(widths[i], cells[i].size());
    }
    std::string text;
    for (const auto& cells : lines) {
        text += fmt::format("{:<{}}", cells[0], widths[0]);
        for (std::size_t i = 1; i < cells.size(); ++i)
            text +=
                fmt::format("  {:>{}}", cells[i], cells.size() == widths.size() ? widths[i] : 0);
        text += "\n";
    }
    return text;
}

}  // namespace

std::string shown(const Column& column, std::optional<double> value) {
    return value ? fmt::format("{:.{}f}", *value * column.factor, column.decimals) : "-";
}

std::string shown(const Column& column, const Score& score) {
    if (column.key != "topology_wrong") return shown(column, column.value(score));
    std::string found = fmt::format("{}, {}", score.topology.components, score.topology.cycles);
    if (score.is_topology_right()) return found;
    return fmt::format("{} not {}, {}", found, score.expected_components,
                       score.expected_cycles ? fmt::to_string(*score.expected_cycles) : "any");
}

bool is_beyond(const Column& column, std::optional<double> value) {
    if (!column.limit || !value) return false;
    return column.worse == Worse::Higher ? *value > *column.limit : *value < *column.limit;
}

std::optional<double> median_of(const Column& column, const std::vector<Row>& rows) {
    std::vector<double> values;
    for (const Row& row : rows) {
        const auto value = row.score ? column.value(*row.score) : std::nullopt;
        if (value) values.push_back(*value);
    }
    return median(values);
}

Totals totals_of(const std::vector<Row>& rows) {
    Totals totals;
    for (const Row& row : rows) {
        if (!row.score) {
            ++totals.failed;
            continue;
        }
        const Score& score = *row.score;
        totals.topology_wrong += score.is_topology_right() ? 0 : 1;
        totals.not_inside += score.inside < kInsideBound ? 1 : 0;
        totals.spurs += score.spurs;
        totals.missed += score.truth ? score.truth->missed.size() : 0;
        totals.invented += score.truth ? score.truth->invented.size() : 0;
    }
    return totals;
}

std::string table_text(const std::vector<Row>& rows) {
    std::vector<std::vector<std::string>> lines{{"model"}, {"median"}};
    for (const Column& column : columns()) {
        lines[0].push_back(column.title);
        lines[1].push_back(shown(column, median_of(column, rows)));
    }
    for (const Row& row : rows) lines.insert(lines.end() - 1, cells_of(row));
    const Totals t = totals_of(rows);
    return aligned(lines) +
           fmt::format(
               "{} models: {} failed, topology wrong {}, below {} inside {}, spurs {}, limbs "
               "missed {}, invented {}\n",
               rows.size(), t.failed, t.topology_wrong, kInsideBound, t.not_inside, t.spurs,
               t.missed, t.invented);
}

std::string table_json(const std::vector<Row>& rows) {
    Json models = Json::array();
    for (const Row& row : rows) models.push_back(to_json(row));
    Json medians;
    for (const Column& column : columns()) medians[column.key] = to_json(median_of(column, rows));
    const Json out{{"format", "zskel-scores"},
                   {"version", 1},
                   {"models", models},
                   {"medians", medians},
                   {"totals", to_json(totals_of(rows))}};
    return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace zskel::scoring
