// Echelon form with pivots of 1 and -1. The vectors modulo those taken are then the vectors without
// the pivot columns, and one of them is part of a basis when its numbers there have greatest common
// divisor 1. Where none of these is 1 or -1, Euclid's algorithm on columns makes one; the steps are
// kept, and repeated on every vector that comes later.
#include "zskel/mesh/integer_basis.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace zskel {
namespace {

// value -= times * other; false when that does not fit.
bool subtract(std::int64_t& value, std::int64_t times, std::int64_t other) {
    std::int64_t product = 0;
    return !__builtin_mul_overflow(times, other, &product) &&
           !__builtin_sub_overflow(value, product, &value);
}

}  // namespace

bool IntegerBasis::reduce(Vector& vector) const {
    for (const ColumnStep& step : steps_) {
        if (!subtract(vector[step.to], step.times, vector[step.from])) return false;
    }
    for (const Row& row : rows_) {
        if (vector[row.pivot] == 0) continue;
        const auto own = std::lower_bound(
            row.entries.begin(), row.entries.end(), row.pivot,
            [](const auto& entry, std::size_t column) { return entry.first < column; });
        const std::int64_t times = vector[row.pivot] * own->second;
        for (const auto& [column, value] : row.entries) {
            if (!subtract(vector[column], times, value)) return false;
        }
    }
    return true;
}

bool IntegerBasis::extend(Vector vector) {
    if (!reduce(vector)) return false;
    std::int64_t divisor = 0;
    for (const std::int64_t value : vector) divisor = std::gcd(divisor, value);
    if (divisor != 1) return false;
    const auto is_unit = [](std::int64_t value) { return std::abs(value) == 1; };
    if (std::none_of(vector.begin(), vector.end(), is_unit)) {
        IntegerBasis stepped = *this;
        if (!stepped.make_unit_entry(vector)) return false;
        *this = std::move(stepped);
    }
    Row row{vector.size(), {}};
    for (std::size_t c = 0; c < vector.size(); ++c) {
        if (vector[c] == 0) continue;
        row.entries.emplace_back(c, vector[c]);
        if (row.pivot == vector.size() && is_unit(vector[c])) row.pivot = c;
    }
    rows_.push_back(std::move(row));
    return true;
}

bool IntegerBasis::spans(Vector vector) const {
    return reduce(vector) &&
           std::all_of(vector.begin(), vector.end(), [](std::int64_t value) { return value == 0; });
}

bool IntegerBasis::make_unit_entry(Vector& vector) {
    while (true) {
        std::size_t least = vector.size();
        for (std::size_t c = 0; c < vector.size(); ++c) {
            if (vector[c] == 0) continue;
            if (least == vector.size() || std::abs(vector[c]) < std::abs(vector[least])) least = c;
        }
        if (std::abs(vector[least]) == 1) return true;
        for (std::size_t c = 0; c < vector.size(); ++c) {
            if (c == least || vector[c] == 0) continue;
            const ColumnStep step{c, least, vector[c] / vector[least]};
            if (!subtract(vector[c], step.times, vector[least]) || !apply(step)) return false;
        }
    }
}

// Repeats a step on the vectors taken; it touches no pivot column.
bool IntegerBasis::apply(const ColumnStep& step) {
    steps_.push_back(step);
    for (Row& row : rows_) {
        Vector dense(width_, 0);
        for (const auto& [column, value] : row.entries) dense[column] = value;
        if (!subtract(dense[step.to], step.times, dense[step.from])) return false;
        row.entries.clear();
        for (std::size_t c = 0; c < dense.size(); ++c) {
            if (dense[c] != 0) row.entries.emplace_back(c, dense[c]);
        }
    }
    return true;
}

std::vector<std::uint32_t> choose_basis(const std::vector<IntegerBasis::Vector>& vectors,
                                        std::size_t count) {
    std::vector<std::uint32_t> chosen;
    IntegerBasis basis(vectors.empty() ? 0 : vectors[0].size());
    for (std::size_t i = vectors.size(); i-- > 0 && chosen.size() < count;) {
        if (basis.extend(vectors[i])) chosen.push_back(static_cast<std::uint32_t>(i));
    }
    return chosen;
}

}  // namespace zskel
