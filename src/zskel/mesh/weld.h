#pragma once

#include <cstdint>
#include <vector>

#include "zskel/core/types.h"

namespace zskel {

/// Numbers places in the order in which they come first; -0 and +0 are the same.
class PlaceIndex {
  public:
    explicit PlaceIndex(std::size_t expected = 0);

    /// The number of the place at `position`, a new one where nothing was before.
    std::uint32_t add(const DVec3& position);

    const std::vector<DVec3>& places() const { return places_; }
    std::vector<DVec3> take_places() { return std::move(places_); }

  private:
    std::size_t slot_of(const DVec3& position) const;
    void grow(std::size_t slots);

    std::vector<DVec3> places_;
    std::vector<std::uint32_t> slots_;  // place numbers by hash, open addressing, at most half full
};

}  // namespace zskel
