#include "zskel/mesh/welded_mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "zskel/core/bucket_sort.h"
#include "zskel/mesh/bounds.h"
#include "zskel/mesh/weld.h"

namespace zskel {
namespace {

bool repeats_place(const Triangle& t) {
    return t.x == t.y || t.y == t.z || t.z == t.x;
}

std::array<std::uint32_t, 3> sorted_corners(const Triangle& t) {
    std::array<std::uint32_t, 3> corners{t.x, t.y, t.z};
    std::sort(corners.begin(), corners.end());
    return corners;
}

}  // namespace

void note(std::vector<Repair>& repairs, std::string what, std::size_t count) {
    if (count > 0) repairs.push_back({std::move(what), count});
}

WeldedMesh weld_equal(const Mesh& mesh, std::vector<Repair>& repairs) {
    WeldedMesh welded;
    welded.place.assign(mesh.positions.size(), kNone);
    PlaceIndex places(mesh.positions.size());
    std::size_t merged = 0;
    std::size_t collapsed = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        Triangle corners;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& place = welded.place[triangle[k]];
            if (place == kNone) {
                const std::size_t known = places.places().size();
                place = places.add(mesh.positions[triangle[k]]);
                const bool is_new = places.places().size() > known;
                merged += is_new ? 0 : 1;
                if (is_new) welded.vertex.push_back(triangle[k]);
            }
            corners[k] = place;
        }
        collapsed += repeats_place(corners) ? 1 : 0;
        if (repeats_place(corners)) continue;
        welded.triangles.push_back(corners);
        welded.input_triangle.push_back(t);
    }
    welded.positions = places.take_places();
    note(repairs, "vertices welded to another at the same position", merged);
    note(repairs, "degenerate faces dropped", collapsed);
    note(repairs, "vertices without a face left out",
         static_cast<std::size_t>(std::count(welded.place.begin(), welded.place.end(), kNone)));
    return welded;
}

std::size_t renumber(WeldedMesh& mesh, const std::vector<std::uint32_t>& number) {
    std::vector<bool> drop(mesh.triangles.size(), false);
    std::vector<bool> is_used(mesh.positions.size(), false);
    std::size_t dropped = 0;
    for (std::size_t t = 0; t < drop.size(); ++t) {
        Triangle& corners = mesh.triangles[t];
        for (int k = 0; k < 3; ++k) corners[k] = number[corners[k]];
        drop[t] = repeats_place(corners);
        dropped += drop[t] ? 1 : 0;
        for (int k = 0; k < 3 && !drop[t]; ++k) is_used[corners[k]] = true;
    }
    drop_triangles(mesh, drop);
    std::vector<std::uint32_t> packed(mesh.positions.size(), kNone);
    std::uint32_t kept = 0;
    for (std::uint32_t p = 0; p < packed.size(); ++p) {
        if (!is_used[p]) continue;
        packed[p] = kept;
        mesh.positions[kept] = mesh.positions[p];
        mesh.vertex[kept++] = mesh.vertex[p];
    }
    mesh.positions.resize(kept);
    mesh.vertex.resize(kept);
    for (Triangle& t : mesh.triangles) t = {packed[t.x], packed[t.y], packed[t.z]};
    for (std::uint32_t& place : mesh.place) {
        if (place != kNone) place = packed[number[place]];
    }
    return dropped;
}

void keep_used_places(WeldedMesh& mesh) {
    std::vector<std::uint32_t> same(mesh.positions.size());
    std::iota(same.begin(), same.end(), 0u);
    renumber(mesh, same);
}

void drop_triangles(WeldedMesh& mesh, const std::vector<bool>& drop) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < drop.size(); ++t) {
        if (drop[t]) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.input_triangle[kept++] = mesh.input_triangle[t];
    }
    mesh.triangles.resize(kept);
    mesh.input_triangle.resize(kept);
}

void drop_duplicates(WeldedMesh& mesh, std::vector<Repair>& repairs) {
    struct Face {
        std::array<std::uint32_t, 3> corners;
        std::uint32_t number;
    };
    const auto for_each_face = [&](const auto& visit) {
        std::uint32_t number = 0;
        for (const Triangle& t : mesh.triangles) visit({sorted_corners(t), number++});
    };
    const std::vector<Face> faces = bucket_sorted<Face>(
        for_each_face, mesh.positions.size(), [](const Face& f) { return f.corners[0]; },
        [](const Face& l, const Face& r) {
            return std::tie(l.corners, l.number) < std::tie(r.corners, r.number);
        });
    std::vector<bool> dropped(faces.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].corners != faces[i - 1].corners) continue;
        dropped[faces[i].number] = true;
        ++count;
    }
    if (count > 0) drop_triangles(mesh, dropped);
    note(repairs, "duplicate faces dropped", count);
}

double diagonal_of(const WeldedMesh& mesh) {
    Box box;
    for (const DVec3& p : mesh.positions) box.add(p);
    return mesh.positions.empty() ? 0.0 : glm::distance(box.low, box.high);
}

}  // namespace zskel
