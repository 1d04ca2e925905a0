#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scoring/score.h"

namespace zskel::scoring {

/// A model of the table.
struct Row {
    std::string name;
    std::string failure;  ///< why there is no score; empty when there is one
    std::optional<Score> score;
    std::string picture;  ///< a PNG's bytes; may be empty
};

enum class Worse { Higher, Lower, Neither };

/// A measure as it stands in the table, in the page's legend and in the JSON.
struct Column {
    std::string key;    ///< in the JSON
    std::string group;  ///< columns of one group stand side by side
    std::string title;
    std::string legend;
    std::function<std::optional<double>(const Score&)> value;
    Worse worse = Worse::Neither;
    std::optional<double> limit = std::nullopt;  ///< a value on the wrong side fails the model
    int decimals = 0;
    double factor = 1.0;  ///< shown as this many times the value: 100 for percent
};

/// All measures, in the table's order; `legend` explains each.
const std::vector<Column>& columns();

/// A value as a reader sees it; "-" where there is none.
std::string shown(const Column& column, std::optional<double> value);
/// The same of a model; topology in words.
std::string shown(const Column& column, const Score& score);

/// Whether a value is on the wrong side of its column's limit.
bool is_beyond(const Column& column, std::optional<double> value);

/// The median of a column over the models that have it.
std::optional<double> median_of(const Column& column, const std::vector<Row>& rows);

/// What has to be nought for a set of models to pass.
struct Totals {
    std::size_t failed = 0;          ///< models without a score
    std::size_t topology_wrong = 0;  ///< models
    std::size_t not_inside = 0;      ///< models with less than kInsideBound inside
    std::size_t spurs = 0;
    std::size_t missed = 0;    ///< limbs
    std::size_t invented = 0;  ///< limbs
    bool are_zero() const {
        return failed + topology_wrong + not_inside + spurs + missed + invented == 0;
    }
};
Totals totals_of(const std::vector<Row>& rows);

/// The table for a terminal: a line a model, medians, totals.
std::string table_text(const std::vector<Row>& rows);

/// Everything as JSON: `models`, each with every column's key, and the names of limbs missed and
/// invented; `medians`; `totals`. What is not known is null.
std::string table_json(const std::vector<Row>& rows);

}  // namespace zskel::scoring
