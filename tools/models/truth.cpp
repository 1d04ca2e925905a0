#include "truth.h"

#include <algorithm>
#include <numeric>

namespace zskel::models {

std::vector<std::size_t> count_degrees(const Truth& truth) {
    std::vector<std::size_t> degrees(truth.nodes.size(), 0);
    for (const auto& [a, b] : truth.edges) {
        ++degrees[a];
        ++degrees[b];
    }
    return degrees;
}

std::size_t count_ends(const Truth& truth) {
    const std::vector<std::size_t> degrees = count_degrees(truth);
    return static_cast<std::size_t>(std::count(degrees.begin(), degrees.end(), 1));
}

std::size_t count_cycles(const Truth& truth) {
    std::vector<std::size_t> leader(truth.nodes.size());
    std::iota(leader.begin(), leader.end(), 0);
    const auto find = [&](std::size_t i) {
        while (leader[i] != i) {
            i = leader[i] = leader[leader[i]];
        }
        return i;
    };
    std::size_t cycles = 0;
    for (const auto& [a, b] : truth.edges) {
        const std::size_t leader_a = find(a), leader_b = find(b);
        cycles += leader_a == leader_b ? 1 : 0;
        leader[leader_a] = leader_b;
    }
    return cycles;
}

}  // namespace zskel::models
