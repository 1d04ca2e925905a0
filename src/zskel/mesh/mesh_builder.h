#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/mesh/mesh.h"

namespace zskel {

/// Collects what a reader finds, in the file's order; polygons wait until all positions are known.
class MeshBuilder {
  public:
    explicit MeshBuilder(std::string_view name) : name_(name) {}

    std::vector<DVec3> positions;
    std::vector<std::string> warnings;

    std::size_t face_count() const { return sizes_.size(); }
    void reserve_faces(std::size_t faces);
    void add_face(std::span<const std::uint32_t> corners) {
        corners_.insert(corners_.end(), corners.begin(), corners.end());
        sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
    }

    /// Adds "`count` `what`" to the warnings when there are any.
    void warn(std::size_t count, std::string_view what);

    /// The mesh, triangulated. Throws InputError when there is no face, or there are too many.
    Mesh finish();

  private:
    std::string name_;
    std::vector<std::uint32_t> corners_;  // of all faces, one behind the other
    std::vector<std::uint32_t> sizes_;    // corners of every face
};

}  // namespace zskel
