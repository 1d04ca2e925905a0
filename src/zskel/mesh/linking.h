#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Which edges a segment passes over, seen along one fixed direction: summed along a closed walk,
/// the signed passages over another closed walk are their linking number.
class Passages {
  public:
    struct Passage {
        std::uint32_t edge;
        std::int32_t sign;
    };

    Passages() = default;
    /// @param edges  pairs of positions.
    Passages(std::span<const Vec3> positions, std::span<const glm::uvec2> edges);

    /// Adds the edges that the segment passes over. Exact in the plane: positions are rounded once,
    /// to 2^-28 of the model's size, and what coincides there is moved apart by the same
    /// infinitesimal step for all segments.
    void find(const Vec3& from, const Vec3& to, std::vector<Passage>& out) const;

  private:
    struct Point {
        std::int64_t x;
        std::int64_t y;
        double z;
    };
    struct Segment {
        Point from;
        Point to;
    };

    Point project(const Vec3& position) const;
    std::int64_t cell(std::int64_t coordinate) const;
    static std::int32_t passage(const Segment& over, const Segment& under);

    double scale_ = 1.0;
    std::int64_t cells_ = 1;  // along a side
    int cell_shift_ = 0;      // of a coordinate, to its cell
    std::vector<Segment> segments_;
    std::vector<std::uint32_t> first_{0, 0};  // of each cell, into `listed_`
    std::vector<std::uint32_t> listed_;
};

/// Closed walks over a surface, and what passes over them.
class LoopPassages {
  public:
    /// @param loops  vertices in order, each.
    LoopPassages(const std::vector<std::vector<std::uint32_t>>& loops,
                 std::span<const Vec3> positions);

    /// Linking numbers of every loop, run through the points `inner`, with every loop, run through
    /// the positions. Work: the passages of the edges used, times the loops through them.
    std::vector<std::vector<std::int64_t>> link(std::span<const Vec3> inner) const;

    /// The loops that a segment passes over, as one sum of a random number for each.
    std::uint64_t hash(const Vec3& from, const Vec3& to) const;

  private:
    struct Use {
        std::uint32_t loop;
        std::int32_t sign;
    };

    std::size_t loop_count_;
    std::vector<glm::uvec2> edges_;       // that loops run along, each once
    std::vector<std::vector<Use>> uses_;  // of each
    std::vector<std::uint64_t> weights_;  // of each: its loops' random numbers
    Passages passages_;
};

/// The k-th of a fixed sequence of random numbers (SplitMix64).
std::uint64_t random_number(std::uint64_t k);

}  // namespace zskel
