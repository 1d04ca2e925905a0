#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "zskel/extract.h"
#include "zskel/visibility/backend.h"
#include "zskel/visibility/visibility_source.h"

namespace zskel {

/// How far two sources differ on the same eyes and directions.
struct Difference {
    double median = 0.0;
    double p999 = 0.0;  ///< 99.9 %
    double worst = 0.0;
    std::size_t count = 0;
};

/// Where the worst texel of a comparison is.
struct WorstTexel {
    DVec3 eye_model{0.0};
    DVec3 direction{0.0};
    float distance = 0.0f;   ///< world units, by the source under test
    float reference = 0.0f;  ///< and by the reference
};

struct SourceComparison {
    std::size_t eyes = 0;
    std::size_t texels = 0;
    Difference
        inner;  ///< |a - b| / b over texels whose neighbours show the same triangle (reference)
    Difference silhouette;  ///< the same over the others
    Difference all;         ///< and over both
    WorstTexel worst_inner;
    std::size_t one_sided = 0;  ///< texels where only one of the two hits anything
    double id_agreement_inner = 1.0;
    double id_agreement_all = 1.0;
    double force_error_median = 0.0;  ///< of records: |Fa - Fb| over the mean of 1/r
    double force_error_p95 = 0.0;
    double force_error_worst = 0.0;
    /// Of records, at eyes that see the same triangles by both (one on a border faces either way):
    /// |Ja - Jb| / |Jb|, by Frobenius' norm.
    double jacobian_error_median = 0.0;
    double jacobian_error_p95 = 0.0;
    double jacobian_error_worst = 0.0;
    std::size_t jacobians = 0;
    double angle_median_deg =
        0.0;  ///< between the forces, only where both exceed 5 % of the mean of 1/r
    double angle_worst_deg = 0.0;
    std::size_t angles = 0;
};

/// Bounds of a comparison; what is within them counts as agreement.
struct ComparisonBounds {
    double texel_median = 1e-5;
    double inner_p999 = 1e-3;
    double force_p95 = 1e-3;
    double jacobian_p95 = 1e-3;
    double angle_median_deg = 0.15;
};
bool is_within(const SourceComparison& comparison, const ComparisonBounds& bounds);

/// Of a backend on a solid of so many triangles: hardware draws corners where they lie to 1/256 of
/// a texel, so that a texel as near to an edge may show the plane beside it; records by coarser
/// levels have wider bounds of their own.
ComparisonBounds bounds_of(const BackendInfo& backend, std::size_t triangles);

/// Eyes on which sources are compared: of seeds spread evenly over the vertices, one third at their
/// starts, one third half-way, one third at their ends, settled by the paper's method with
/// `source`.
std::vector<Vec3> comparison_eyes(const Surface& solid, VisibilitySource& source, int count,
                                  const ExtractOptions& options);

/// Compares cube maps of two sources of one solid, and the records that `tested` gives for steps to
/// go by with those of the reference's maps. Both must
/// sample the same directions.
/// @throws UsageError when they do not.
SourceComparison compare_sources(VisibilitySource& tested, VisibilitySource& reference,
                                 std::span<const Vec3> eyes);

/// The same over a whole mesh: every solid gets its share of `eyes`, by vertices, at least 3.
/// @throws InputError, GlError, UsageError.
SourceComparison compare_backends(const Mesh& mesh, Backend& tested, Backend& reference, int eyes,
                                  const ExtractOptions& options);

/// How far two skeletons of one mesh by the same method differ. The paper's stop rule is touchy, so
/// single seeds may part company where two ways are equally good.
struct SkeletonComparison {
    std::size_t seeds = 0;
    std::vector<std::uint32_t> parted;  ///< vertices whose seeds end more than the tolerance apart
    std::size_t nodes_tested = 0;
    std::size_t nodes_reference = 0;
    double mean_distance_diagonals =
        0.0;  ///< between the curves, both ways, over the model's diagonal
};
struct SkeletonBounds {
    double parted_share = 0.05;
    double node_share = 0.1;
    double mean_distance_diagonals = 0.005;
};
bool is_within(const SkeletonComparison& comparison, const SkeletonBounds& bounds);

/// Skeletons by coarser levels are to be nearer, as the same seeds go the same ways.
SkeletonBounds skeleton_bounds_of(const BackendInfo& backend, std::size_t triangles);

/// @param tolerance  how far apart ends of one seed may be, model units.
SkeletonComparison compare_skeletons(const ExtractResult& tested, const ExtractResult& reference,
                                     double tolerance);

/// Mean distance from points spread along one skeleton to the other, averaged both ways, model
/// units. A node without edges counts as a point. 0 for two empty graphs, infinite when only one
/// is.
double mean_distance(const SkeletonGraph& a, const SkeletonGraph& b);

}  // namespace zskel
