#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace zskel::scoring {

/// The value below which a share of the values lies, linear between two of them; none without
/// values.
inline std::optional<double> quantile(std::vector<double> values, double share) {
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(std::floor(rank));
    const auto high = static_cast<std::size_t>(std::ceil(rank));
    return std::lerp(values[low], values[high], rank - std::floor(rank));
}

inline std::optional<double> median(const std::vector<double>& values) {
    return quantile(values, 0.5);
}

inline std::optional<double> mean(const std::vector<double>& values) {
    if (values.empty()) return std::nullopt;
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

}  // namespace zskel::scoring
