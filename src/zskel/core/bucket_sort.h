#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zskel {

/// Sorts by `bucket_of`, a number below `buckets`, and within a bucket by `before`. O(n + buckets)
/// where buckets are small, as the triangles of a vertex are.
template <typename Item, typename BucketOf, typename Before>
std::vector<Item> bucket_sorted(const std::vector<Item>& items, std::size_t buckets,
                                const BucketOf& bucket_of, const Before& before) {
    std::vector<std::uint32_t> end(buckets + 1, 0);
    for (const Item& item : items) ++end[bucket_of(item) + 1];
    for (std::size_t b = 0; b < buckets; ++b) end[b + 1] += end[b];
    std::vector<Item> sorted(items.size());
    for (const Item& item : items) sorted[end[bucket_of(item)]++] = item;
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        std::sort(sorted.begin() + first, sorted.begin() + end[b], before);
        first = end[b];
    }
    return sorted;
}

}  // namespace zskel
