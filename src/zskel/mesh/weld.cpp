#include "zskel/mesh/weld.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <bit>

namespace zskel {
namespace {

constexpr std::size_t kFewestSlots = 16;

std::uint64_t hash_of(const DVec3& position) {
    const DVec3 key = position + DVec3(0.0);  // -0 becomes +0
    return XXH3_64bits(&key, sizeof key);
}

}  // namespace

PlaceIndex::PlaceIndex(std::size_t expected) {
    places_.reserve(expected);
    grow(std::bit_ceil(std::max(expected * 2, kFewestSlots)));
}

std::uint32_t PlaceIndex::add(const DVec3& position) {
    if (places_.size() * 2 >= slots_.size()) grow(slots_.size() * 2);
    std::uint32_t& slot = slots_[slot_of(position)];
    if (slot == kNone) {
        slot = static_cast<std::uint32_t>(places_.size());
        places_.push_back(position);
    }
    return slot;
}

std::size_t PlaceIndex::slot_of(const DVec3& position) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(position) & mask;
    while (slots_[slot] != kNone && places_[slots_[slot]] != position) slot = (slot + 1) & mask;
    return slot;
}

void PlaceIndex::grow(std::size_t slots) {
    slots_.assign(slots, kNone);
    for (std::uint32_t place = 0; place < places_.size(); ++place) {
        slots_[slot_of(places_[place])] = place;
    }
}

}  // namespace zskel
