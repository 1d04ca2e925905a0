#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "zskel/mesh/integer_basis.h"
#include "zskel/mesh/linking.h"
#include "zskel/mesh/small_handles.h"
#include "zskel/mesh/surface.h"

namespace zskel {

/// The handles of a solid, as integers on the walks over its surface: their classes in the first
/// homology of the *solid*, where a loop that bounds a disc inside counts for nothing. A class is
/// `genus` numbers, and then one for each small handle that is cut: how often the walk goes through
/// it.
class HandleClasses {
  public:
    using Class = IntegerBasis::Vector;

    std::size_t genus = 0;             ///< summed over the shells: independent cycles inside
    std::vector<SmallHandle> ignored;  ///< not to be given a cycle, smallest first

    std::size_t cycles() const { return genus - ignored.size(); }
    std::size_t width() const { return genus + cuts_; }
    Class zero() const { return Class(width(), 0); }

    /// Adds the class of an edge of Surface::edges, walked from its low to its high vertex or back.
    void add_edge(Class& sum, std::uint32_t edge, bool is_forward) const;

    /// Whether a walk of this class goes through a small handle that is cut.
    bool is_cut(const Class& cls) const;

    /// A number for a segment inside the solid, to be summed along paths: two paths between the
    /// same ends have the same sum if they differ by nothing in the solid's homology (small handles
    /// included), and only then but for a chance of about 2^-60.
    std::uint64_t segment_sum(const Vec3& from, const Vec3& to) const;

    /// The same for an edge of Surface::edges through the inner points, walked as in `add_edge`.
    std::uint64_t edge_sum(std::uint32_t edge, bool is_forward) const;

  private:
    friend class HandleFinder;
    friend class CycleBasis;

    std::size_t cuts_ = 0;
    std::vector<Class> filled_;          // of the small handles that are filled
    std::vector<glm::uvec2> edge_span_;  // an edge's class is the difference of two sums
    std::vector<Class> sums_;            // over the sides before each; see LoopSystem
    std::vector<std::uint64_t> edge_sums_;
    std::optional<LoopPassages> passages_;
};

/// Cycles of a skeleton, gathered one by one: the classes of those taken are part of a basis over
/// the integers, small handles apart.
class CycleBasis {
  public:
    explicit CycleBasis(const HandleClasses& handles);
    bool extend(const HandleClasses::Class& cls);
    bool is_complete() const { return taken_ == handles_.cycles(); }

  private:
    const HandleClasses& handles_;
    IntegerBasis basis_;
    std::size_t taken_ = 0;
};

/// A system of 2g loops, the linking numbers of the loops pushed inside with the loops themselves,
/// and from those the classes of all edges: linking numbers with g loops that are a basis outside.
/// @param inner             a point inside for every vertex, near it.
/// @param min_radius_world  handles smaller than this are ignored; see SmallHandle.
/// @return nothing when the surface is not closed, oriented and manifold, or when the linking
/// numbers do not have rank g (surfaces that cut through themselves); `why` then says so.
/// Work: O(n log n) for the loops, the edges' passages for the numbers, at most O(g^3) for the
/// basis.
std::optional<HandleClasses> find_handles(const Surface& surface, const std::vector<Vec3>& inner,
                                          double min_radius_world, std::string& why);

}  // namespace zskel
