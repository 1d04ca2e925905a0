#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/core/assert.h"
#include "zskel/mesh/mesh.h"

namespace zskel {

/// Collects what a reader finds, in the file's order; polygons wait until all positions are known.
class MeshBuilder {
  public:
    /// @param name       stands in messages.
    /// @param max_faces  triangles that may come of the faces; 0: as many as can be numbered.
    MeshBuilder(std::string_view name, std::size_t max_faces)
        : name_(name), max_faces_(max_faces) {}

    std::vector<DVec3> positions;
    std::vector<std::string> warnings;

    std::size_t face_count() const { return sizes_.size(); }
    void reserve_faces(std::size_t faces);
    /// @param corners  three or more.
    /// @throws LimitError as soon as there are too many.
    void add_face(std::span<const std::uint32_t> corners) {
        ZSKEL_ASSERT(corners.size() >= 3, "a face has an area");
        triangles_ += corners.size() - 2;
        if (max_faces_ > 0 && triangles_ > max_faces_) fail_too_many();
        corners_.insert(corners_.end(), corners.begin(), corners.end());
        sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
    }

    /// Adds "`count` `what`" to the warnings when there are any.
    void warn(std::size_t count, std::string_view what);

    /// The mesh, triangulated. Throws InputError when there is no face, or there are too many.
    Mesh finish();

  private:
    [[noreturn]] void fail_too_many() const;

    std::string name_;
    std::size_t max_faces_;
    std::size_t triangles_ = 0;
    std::vector<std::uint32_t> corners_;  // of all faces, one behind the other
    std::vector<std::uint32_t> sizes_;    // corners of every face
};

}  // namespace zskel
