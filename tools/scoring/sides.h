#pragma once

#include <span>
#include <vector>

#include "scoring/curve.h"
#include "scoring/subject.h"

namespace zskel::scoring {

/// Which parts of a skeleton lie inside a model. Winding numbers are found at few nodes only: along
/// an edge that meets no surface nothing changes, unless the model has openings.
class CurveSides {
  public:
    /// Both must outlive this; `graph` in diagonals.
    CurveSides(const Subject& subject, const SkeletonGraph& graph);

    bool is_inside(const CurveSample& sample) const;
    /// By the samples' weights.
    double inside_share(std::span<const CurveSample> samples) const;

  private:
    const Subject& subject_;
    const SkeletonGraph& graph_;
    std::vector<bool> node_inside_;
    std::vector<bool> edge_free_;
};

}  // namespace zskel::scoring
