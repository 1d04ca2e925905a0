#pragma once

#include <string>
#include <vector>

#include "zskel/mesh/read_mesh.h"
#include "zskel/mesh/surface.h"
#include "zskel/skeleton/seeds.h"
#include "zskel/visibility/surface_query.h"

namespace zskel::test {

/// One of our models (`models/`), in the world that newton works in.
inline PreparedSurface model(const std::string& name) {
    return prepare_surface(read_mesh(ZSKEL_MODELS "/" + name + ".obj"), WorldSize::Spread);
}

/// A seed inside every `stride`-th vertex.
inline std::vector<Seed> some_seeds(const Surface& surface, std::size_t stride) {
    const std::vector<Seed> all = place_seeds(surface, SurfaceQuery(surface), {});
    std::vector<Seed> some;
    for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
    return some;
}

}  // namespace zskel::test
