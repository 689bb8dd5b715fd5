#pragma once

#include "base/progress.h"
#include "pipeline/pipeline.h"
#include "tests/measure/bench/depth_bench.h"
#include "tests/measure/bench/render_bench.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/triangulation_bench.h"
#include "tests/measure/bench/warp_bench.h"
#include "tests/measure/bench/workload.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mfar::bench {

struct StageSummary {
    std::string stage;
    Summary ms;
};

/// Our pipeline on one workload.
struct CaseResult {
    std::string name;
    Summary frame;                     ///< whole frame from upload to finished picture
    std::vector<StageSummary> stages;  ///< from a separate run in which each stage waits for its
                                       ///< end
    std::array<double, kTileClasses> tileShare{};  ///< mean share of the tiles of each TileClass
};

/// OpenCV's version of the paper's method on a moving camera; its frames are run in turn with ours.
struct PeerResult {
    std::string name;
    std::string of;  ///< name of our case
    Summary frame;
    double ratio = 0;          ///< our median over the peer's: below 1 ours is faster
    double low = 0, high = 0;  ///< 10th and 90th percentile of the ratio of single frames
};

/// Moving frames with another number of threads or output size.
struct ScalingResult {
    int threads = 0;
    Size output;
    Summary moving, handheld;
};

struct BenchResult {
    std::string workload;  ///< source of the moving and resting frames
    std::string posed;     ///< source of the hand-held frames
    std::string renderer;
    Size video, still, output;
    Summary setStill;  ///< per-still work of our pipeline
    std::vector<CaseResult> cases;
    std::vector<PeerResult> peers;
    DepthTimes depth;  ///< on the hand-held frames
    WarpTimes warp;    ///< at the video's size
    TriangulationTimes triangulation;
    std::vector<ScalingResult> scaling;
    RenderFigures render;
};

/// Filters learned from a workload's lessons, as in the daemon; null: no lessons. Prints one line
/// on what was learned to stderr.
[[nodiscard]] std::shared_ptr<const FilterBank> learnedFrom(const Workload& work);

/// Needs a current GL context, described by `renderer`. The first frames warm up and do not count.
/// Uses the poses of `posed`, not those of `moving`; `posed` without frames is skipped.
[[nodiscard]] BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                                   EngineKind engine, const std::string& renderer,
                                   const ProgressPart& progress = {});
/// With one and two threads, at three output sizes.
[[nodiscard]] std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                                    SuperResMode mode, EngineKind engine,
                                                    const ProgressPart& progress = {});

}  // namespace mfar::bench
