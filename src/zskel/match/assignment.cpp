#include "zskel/match/assignment.h"

#include <limits>

#include "zskel/core/types.h"

namespace zskel {

std::vector<std::uint32_t> cheapest_assignment(const std::vector<double>& cost, std::size_t n) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<double> row_price(n, 0.0);
    std::vector<double> column_price(n, 0.0);
    std::vector<std::uint32_t> row_of(n, kNone);
    // Each row is brought in by the cheapest chain of changes that ends at a free column.
    for (std::uint32_t start = 0; start < n; ++start) {
        std::vector<double> way(n, kFar);             // to each column, in reduced costs
        std::vector<std::uint32_t> before(n, kNone);  // the column before it on that way
        std::vector<bool> is_settled(n, false);
        std::uint32_t row = start;
        std::uint32_t column = kNone;
        double passed = 0.0;
        while (true) {
            std::uint32_t next = kNone;
            for (std::uint32_t c = 0; c < n; ++c) {
                if (is_settled[c]) continue;
                const double through =
                    passed + cost[row * n + c] - row_price[row] - column_price[c];
                if (through < way[c]) {
                    way[c] = through;
                    before[c] = column;
                }
                if (next == kNone || way[c] < way[next]) next = c;
            }
            column = next;
            passed = way[column];
            is_settled[column] = true;
            if (row_of[column] == kNone) break;
            row = row_of[column];
        }
        row_price[start] += passed;
        for (std::uint32_t c = 0; c < n; ++c) {
            if (!is_settled[c] || c == column) continue;
            row_price[row_of[c]] += passed - way[c];
            column_price[c] -= passed - way[c];
        }
        while (before[column] != kNone) {
            row_of[column] = row_of[before[column]];
            column = before[column];
        }
        row_of[column] = start;
    }
    std::vector<std::uint32_t> column_of(n, kNone);
    for (std::uint32_t c = 0; c < n; ++c) column_of[row_of[c]] = c;
    return column_of;
}

}  // namespace zskel
