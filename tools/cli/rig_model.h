#pragma once

#include "command.h"
#include "zskel/extract.h"
#include "zskel/rig/weights.h"

namespace zskel::cli {

/// What `rig` and `deform` are told about bones.
struct RigOptions {
    ExtractOptions extract;
    ArmatureOptions armature;
    WeightOptions weights;
    BackendOptions backend;
};

struct RiggedModel {
    SkeletonGraph graph;
    Armature armature;
    std::vector<std::vector<Influence>> weights;
};

/// Adds --max-bones, --detail, --smoothing and the choice of backend to a subcommand.
void add_rig_options(CLI::App& command, RigOptions& options);

/// Mesh to skeleton to bones to weights; what was left out is said in the log.
RiggedModel rig_model(const Mesh& mesh, const RigOptions& options);

}  // namespace zskel::cli
