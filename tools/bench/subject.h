#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "zskel/compare.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/solid.h"

namespace zskel::bench {

/// The largest solid of a model.
struct Subject {
    std::string name;  ///< with its number of triangles
    Surface surface;
    std::vector<Vec3> eyes;  ///< as `compare` takes them
};

/// @param backend  to settle the eyes by. @throws as read_mesh and the backend do.
inline Subject load_subject(const std::string& path, Backend& backend, int eyes) {
    const std::vector<Solid> solids =
        split_solids(prepare_surface(read_mesh(path), WorldSize::Spread));
    const auto largest =
        std::max_element(solids.begin(), solids.end(), [](const Solid& l, const Solid& r) {
            return l.surface.triangles.size() < r.surface.triangles.size();
        });
    Subject subject{fmt::format("{}:{}", std::filesystem::path(path).stem().string(),
                                largest->surface.triangles.size()),
                    largest->surface,
                    {}};
    const auto source = backend.prepare(subject.surface);
    subject.eyes = comparison_eyes(subject.surface, *source, eyes, {});
    return subject;
}

}  // namespace zskel::bench
