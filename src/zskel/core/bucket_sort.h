#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zskel {

/// Sorts by `bucket_of`, a number below `buckets`, and within a bucket by `before`. O(n + buckets)
/// where buckets are small, as the triangles of a vertex are.
/// @param for_each  calls what it is given with every item; asked twice, so that there is one copy.
template <typename Item, typename ForEach, typename BucketOf, typename Before>
std::vector<Item> bucket_sorted(const ForEach& for_each, std::size_t buckets,
                                const BucketOf& bucket_of, const Before& before) {
    std::vector<std::uint32_t> end(buckets + 1, 0);
    for_each([&](const Item& item) { ++end[bucket_of(item) + 1]; });
    for (std::size_t b = 0; b < buckets; ++b) end[b + 1] += end[b];
    std::vector<Item> sorted(end.back());
    for_each([&](const Item& item) { sorted[end[bucket_of(item)]++] = item; });
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        std::sort(sorted.begin() + first, sorted.begin() + end[b], before);
        first = end[b];
    }
    return sorted;
}

}  // namespace zskel
