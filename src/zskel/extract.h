#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zskel/core/error.h"
#include "zskel/join.h"
#include "zskel/mesh/mesh.h"
#include "zskel/mesh/surface.h"
#include "zskel/self_check.h"
#include "zskel/skeleton/graph.h"
#include "zskel/skeleton/method.h"
#include "zskel/visibility/backend.h"

namespace zskel {

/// How seeds find the skeleton.
enum class Method {
    Newton,  ///< Newton steps on the force, right topology, refined
    Paper,   ///< steps of one length along the force, as published
};
Method parse_method(std::string_view name);
std::string_view name_of(Method method);

struct ExtractOptions {
    Method method = Method::Newton;
    RepairOptions repair{.has_caps = true};
    std::optional<JoinOptions> join;  ///< parts that overlap or touch become one
    NewtonMethodOptions newton;
    PaperMethodOptions paper;
    /// Told the stage and its share done, on the caller's thread; false stops the work (`Cancelled`
    /// is thrown). May be empty.
    std::function<bool(std::string_view stage, double share)> progress;
};

/// Thrown when the progress callback says stop.
class Cancelled : public Error {
  public:
    Cancelled() : Error(ExitCode::Internal, "stopped by the caller") {}
};

/// One seed's story, in model space.
struct SeedReport {
    std::uint32_t vertex =
        0;  ///< an input vertex at the seed's place (the first of those welded there)
    std::uint32_t node = 0;
    DVec3 start{0.0};
    DVec3 end{0.0};
    SeedState state = SeedState::Converged;
    std::uint32_t steps = 0;
    std::uint32_t evaluations = 0;
    std::vector<DVec3> path;  ///< start to end; empty unless paths are kept
};

/// A handle that was too small to be given a cycle, in model space.
struct IgnoredHandle {
    double radius = 0.0;  ///< length of its shortest loop over 2 pi
    DVec3 position{0.0};  ///< middle of that loop
    bool is_cut = false;  ///< the loop goes round the handle itself; otherwise round its hole
    std::uint32_t solid = 0;
};

struct StageTime {
    std::string stage;
    double seconds = 0.0;
};

struct ExtractStatistics {
    std::size_t faces = 0;     ///< triangles used
    std::size_t vertices = 0;  ///< places used
    std::size_t solids = 0;
    std::size_t cavities = 0;
    std::size_t openings = 0;   ///< closed by caps
    std::size_t open_ends = 0;  ///< branches that end at one
    std::size_t seeds = 0;
    double seed_spacing_thickness = 0.0;          ///< the widest of the solids'; see SeedSpread
    SpreadEnd seed_end = SpreadEnd::EveryVertex;  ///< of that solid
    std::size_t evaluations = 0;
    std::size_t expected_cycles =
        0;                  ///< handles of the closed solids, but those ignored; newton only
    std::size_t limbs = 0;  ///< branches grown; newton only
    std::size_t rejected_limbs = 0;  ///< that were too small
    RefineReport refine;
    std::size_t forest_edges =
        0;  ///< edges that are left when every cycle is opened at its longest
    std::vector<StageTime> stages;
    double seconds() const;
};

struct ExtractResult {
    SkeletonGraph graph;
    std::vector<SeedReport> seeds;
    std::vector<IgnoredHandle> ignored_handles;  ///< of each solid the smallest first
    ExtractStatistics statistics;
    SelfCheck check;
    std::vector<Repair> repairs;
    std::vector<std::string> warnings;
    Surface surface;  ///< what was worked on: all solids, world space
};

/// What `backend` leaves open, filled in for this work. Maps of 10 texels a face for newton, whose
/// skeletons 16 do not better (tools/bench/RESULTS.md), of 16 for the paper's method, whose stop
/// rule hangs on the force's last digits; and for Auto how much there is to do.
BackendOptions backend_options_for(const Mesh& mesh, const ExtractOptions& options,
                                   BackendOptions backend);

/// The whole pipeline: mesh -> surface -> solids -> seeds -> settled seeds -> clusters -> graph ->
/// refined. Same mesh, options and backend give the same graph, at any number of threads.
///
/// Threads: several extractions may run at once, each with a backend of its own. Meshes and options
/// are only read and may be shared. Inside, the work is spread over TBB's threads; `progress` is
/// called on the caller's thread only, so options that are shared must hold one that bears several.
/// `set_log` and `set_thread_limit` act on the whole process: call them before the threads start.
///
/// A GL context that is current on the caller's thread stays so and is not used: a GL backend has
/// its context on a thread of its own. EGL displays are the process's: a caller must not terminate
/// one (eglTerminate) that an open backend may use.
/// @throws InputError for a mesh without area or that may not be repaired, GlError when the backend
/// fails, Cancelled; whatever `progress` throws. The backend stays usable after Cancelled, and
/// after what `progress` threw.
ExtractResult extract_skeleton(const Mesh& mesh, const ExtractOptions& options, Backend& backend);

}  // namespace zskel
