#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace zskel {

/// Integer vectors that are part of a basis of all of them, gathered one by one. Exact: a sum that
/// does not fit 64 bits makes the vector be refused.
class IntegerBasis {
  public:
    using Vector = std::vector<std::int64_t>;

    explicit IntegerBasis(std::size_t width) : width_(width) {}

    /// Takes the vector if it and those taken before can be part of a basis together (their maximal
    /// minors have greatest common divisor 1); says whether it was taken. Work: the non-zero
    /// numbers of the vectors that it has to be reduced by.
    bool extend(Vector vector);

    /// Whether the vector is a combination of those taken.
    bool spans(Vector vector) const;

    std::size_t size() const { return rows_.size(); }

  private:
    // A taken vector, reduced by those before; its number at `pivot` is 1 or -1.
    struct Row {
        std::size_t pivot;
        std::vector<std::pair<std::size_t, std::int64_t>> entries;
    };
    // column[to] -= times * column[from], in every vector.
    struct ColumnStep {
        std::size_t to;
        std::size_t from;
        std::int64_t times;
    };

    bool reduce(Vector& vector) const;
    bool make_unit_entry(Vector& vector);
    bool apply(const ColumnStep& step);

    std::vector<Row> rows_;
    std::vector<ColumnStep> steps_;
    std::size_t width_;
};

/// Numbers of `count` of the vectors that are part of a basis together, the last taken first; fewer
/// where there are no more.
std::vector<std::uint32_t> choose_basis(const std::vector<IntegerBasis::Vector>& vectors,
                                        std::size_t count);

}  // namespace zskel
