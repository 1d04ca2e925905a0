#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "zskel/mesh/homology.h"
#include "zskel/mesh/vertex_graph.h"
#include "zskel/skeleton/cluster.h"
#include "zskel/skeleton/settle.h"
#include "zskel/skeleton/shortcuts.h"
#include "zskel/skeleton/spread.h"
#include "zskel/visibility/surface_query.h"

namespace zskel {

/// What the joining of clusters needs to look at. All of one solid.
struct ClusterContext {
    const Surface& surface;
    const SurfaceQuery& query;
    const SeedSpread& spread;
    std::span<const SettledSeed> settled;  ///< with paths
    std::span<const Vec3> inner;           ///< a point inside near every vertex
    std::span<const glm::uvec2> links;     ///< pairs of seeds whose patches meet
    std::span<const Shortcut> shortcuts;
    const Clusters& clusters;       ///< of seeds; centres are end points of seeds
    std::span<const float> girths;  ///< at the centres, see `girths_at`
    bool is_closed = true;          ///< the solid: then nothing of the skeleton may leave it
};

/// For every vertex a walk to it from the centre of its cluster, and what the walk counts for in
/// the solid's homology: up the path of the seed that rests at the centre, from seed to seed where
/// their patches meet or a shortcut joins them, then along the vertex's parents.
class SurfaceWalks {
  public:
    /// All must outlive this.
    SurfaceWalks(const ClusterContext& context, const HandleClasses& handles);

    std::uint32_t cluster_of(std::uint32_t vertex) const {
        return context_.clusters.of_point[context_.spread.seed_of[vertex]];
    }

    /// The walk's HandleClasses::segment_sum.
    std::uint64_t sum_to(std::uint32_t vertex) const {
        return seed_sums_[context_.spread.seed_of[vertex]] + cell_sums_[vertex];
    }

    /// The walk's class; those of one cluster all lack the same.
    HandleClasses::Class class_to(std::uint32_t vertex) const;

    /// The walk through the inner points, from the centre to the vertex.
    std::vector<Vec3> walk_to(std::uint32_t vertex) const;

    /// A shorter way that may count for something else: straight to where the vertex's own seed
    /// rests, up its path and along the parents.
    std::vector<Vec3> short_way_to(std::uint32_t vertex) const;

    std::uint64_t sum_of(std::span<const Vec3> path) const;

  private:
    // From one seed's vertex to another's over seeds in between.
    struct Way {
        std::uint32_t seed = kNone;
        std::vector<std::uint32_t> seeds;  // from, .., to
    };

    void walk_cells();
    void find_links();
    void walk_clusters();
    std::vector<std::vector<Way>> find_ways() const;
    std::uint32_t edge_between(std::uint32_t v, std::uint32_t w) const;
    glm::uvec2 link_between(std::uint32_t from, std::uint32_t to) const;
    std::uint64_t link_sum(std::uint32_t from, std::uint32_t to) const;
    void add_cell_class(HandleClasses::Class& sum, std::uint32_t vertex, bool is_forward) const;
    void add_link_class(HandleClasses::Class& sum, std::uint32_t from, std::uint32_t to) const;
    std::vector<std::uint32_t> parents_of(std::uint32_t vertex) const;
    void append_seed_walk(std::uint32_t seed, std::vector<Vec3>& way) const;

    const ClusterContext& context_;
    const HandleClasses& handles_;
    VertexGraph graph_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::uvec2>
        links_;  // of seeds, lower first: vertices of an edge from one's patch to the other's
    std::vector<std::uint64_t> cell_sums_;            // of every vertex: from its seed's
    std::vector<std::uint64_t> seed_sums_;            // of every seed's vertex: from the centre
    std::vector<HandleClasses::Class> seed_classes_;  // from the centre's own seed's vertex
    std::vector<Way> ways_;                           // of every seed: from the one before it
    std::vector<std::uint32_t> central_;              // of every cluster: the seed at its centre
};

}  // namespace zskel
