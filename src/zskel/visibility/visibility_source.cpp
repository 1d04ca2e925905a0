#include "zskel/visibility/visibility_source.h"

#include <algorithm>
#include <utility>

#include "zskel/core/assert.h"
#include "zskel/core/parallel.h"

namespace zskel {

void MapBatch::resize(std::size_t eyes, std::size_t directions_per_eye) {
    directions = directions_per_eye;
    distance.resize(eyes * directions_per_eye);
    id.resize(eyes * directions_per_eye);
}

MapView MapBatch::view(std::size_t eye) const {
    return {std::span(distance).subspan(eye * directions, directions),
            std::span(id).subspan(eye * directions, directions)};
}

VisibilitySource::VisibilitySource(const Surface& solid, Directions directions)
    : solid_(solid), directions_(std::move(directions)) {}

void VisibilitySource::look(std::span<const Vec3> eyes, std::span<EyeRecord> records) {
    ZSKEL_ASSERT(eyes.size() == records.size(), "one record an eye");
    constexpr std::size_t kMaxTexels = std::size_t{1} << 22;  // bounds the scratch maps to 32 MB
    const std::size_t batch = std::max<std::size_t>(1, kMaxTexels / directions_.size());
    for (std::size_t first = 0; first < eyes.size(); first += batch) {
        const std::size_t count = std::min(batch, eyes.size() - first);
        render(eyes.subspan(first, count), scratch_);
        parallel_for(count, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                records[first + i] = summarize(directions_, scratch_.view(i), solid_);
            }
        });
    }
}

}  // namespace zskel
