#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "zskel/core/parallel.h"

namespace zskel {

/// Sorts by `bucket_of`, a number below `buckets`, and within a bucket by `before`. O(n + buckets)
/// where buckets are small, as the triangles of a vertex are. Every thread walks over all items and
/// takes those of its own buckets: what a locked counter costs is more than the walk.
/// @param for_each  calls what it is given with every item; asked twice by every thread, so that
///                  there is one copy.
template <typename Item, typename ForEach, typename BucketOf, typename Before>
std::vector<Item> bucket_sorted(const ForEach& for_each, std::size_t buckets,
                                const BucketOf& bucket_of, const Before& before) {
    constexpr std::size_t kMostShares = 8;
    constexpr std::size_t kLeastBuckets = 4096;  // that are worth a walk
    const std::size_t shares = std::clamp<std::size_t>(
        buckets / kLeastBuckets, 1,
        std::min<std::size_t>(kMostShares, static_cast<std::size_t>(thread_count())));
    const auto for_each_share = [&](const auto& work) {
        parallel_for(shares, 1, [&](std::size_t begin, std::size_t end) {
            work(buckets * begin / shares, buckets * end / shares);
        });
    };
    const auto for_each_within = [&](std::size_t low, std::size_t high, const auto& visit) {
        for_each([&](const Item& item) {
            const std::size_t bucket = bucket_of(item);
            if (bucket >= low && bucket < high) visit(bucket, item);
        });
    };
    std::vector<std::uint32_t> end(buckets + 1, 0);
    for_each_share([&](std::size_t low, std::size_t high) {
        for_each_within(low, high,
                        [&](std::size_t bucket, const Item& /*item*/) { ++end[bucket + 1]; });
    });
    for (std::size_t b = 0; b < buckets; ++b) end[b + 1] += end[b];
    std::vector<Item> sorted(end.back());
    const std::vector<std::uint32_t> start(end);
    for_each_share([&](std::size_t low, std::size_t high) {
        for_each_within(
            low, high, [&](std::size_t bucket, const Item& item) { sorted[end[bucket]++] = item; });
        for (std::size_t b = low; b < high; ++b)
            std::sort(sorted.begin() + start[b], sorted.begin() + end[b], before);
    });
    return sorted;
}

}  // namespace zskel
