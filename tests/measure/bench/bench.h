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

/// Times of the product's pipeline on one workload.
struct CaseResult {
    std::string name;
    Summary frame;                     ///< whole frame from upload to finished picture
    std::vector<StageSummary> stages;  ///< from a separate run that waits after each stage
    std::array<double, kTileClasses> tileShare{};  ///< mean share of the tiles of each TileClass
};

/// OpenCV's version of the paper's method on a moving camera. Its frames alternate with ours.
struct PeerResult {
    std::string name;
    std::string of;  ///< name of our case that it is compared with
    Summary frame;
    double ratio = 0;          ///< our median over the peer's; below 1: ours is faster
    double low = 0, high = 0;  ///< 10th and 90th percentile of the ratio of single frames
};

/// Times with another number of threads or another output size, for moving and hand-held frames.
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
    Summary setStill;  ///< work of our pipeline for each new still
    std::vector<CaseResult> cases;
    std::vector<PeerResult> peers;
    DepthTimes depth;  ///< on the hand-held frames
    WarpTimes warp;    ///< at the video's size
    TriangulationTimes triangulation;
    std::vector<ScalingResult> scaling;
    RenderFigures render;
};

/// Learns filters from the lessons of a workload, as the daemon does; null without lessons. Prints
/// one line on what was learned to stderr.
[[nodiscard]] std::shared_ptr<const FilterBank> learnedFrom(const Workload& work);

/// Needs a current GL context; `renderer` describes it. The first frames warm up and do not count.
/// `moving`: its poses are not used. `posed`: its poses are used; it is skipped if it has no
/// frames.
[[nodiscard]] BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                                   EngineKind engine, const std::string& renderer,
                                   const ProgressPart& progress = {});
/// Measures with one and with two threads, at three output sizes.
[[nodiscard]] std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                                    SuperResMode mode, EngineKind engine,
                                                    const ProgressPart& progress = {});

}  // namespace mfar::bench
