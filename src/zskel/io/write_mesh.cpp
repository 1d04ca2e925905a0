#include "zskel/io/write_mesh.h"

#include <fmt/format.h>

#include <iterator>

namespace zskel {

std::string write_obj_mesh(const std::vector<DVec3>& positions,
                           const std::vector<Triangle>& triangles, const std::string& origin) {
    std::string out = fmt::format("# {}\n", origin);
    for (const DVec3& p : positions)
        fmt::format_to(std::back_inserter(out), "v {} {} {}\n", p.x, p.y, p.z);
    for (const Triangle& t : triangles)
        fmt::format_to(std::back_inserter(out), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return out;
}

}  // namespace zskel
