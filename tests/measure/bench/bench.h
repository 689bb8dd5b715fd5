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

/// Times of the paper's method, built on OpenCV, with a moving camera. Its frames were run in turn
/// with the product's.
struct PeerResult {
    std::string name;
    std::string of;  ///< name of the CaseResult with which the peer is compared
    Summary frame;
    double ratio = 0;          ///< the product's median time over the peer's; below 1: faster
    double low = 0, high = 0;  ///< 10th and 90th percentile of the frames' ratios
};

/// Frame times with this number of threads and this output size, for the cases "moving" and
/// "handheld".
struct ScalingResult {
    int threads = 0;
    Size output;
    Summary moving, handheld;
};

struct BenchResult {
    std::string workload;  ///< name of the workload of "moving" and both "rest" cases
    std::string posed;     ///< name of the workload of "handheld"; may be empty
    std::string renderer;
    Size video, still, output;
    Summary setStill;  ///< time of the pipeline's work for each new still
    std::vector<CaseResult> cases;
    std::vector<PeerResult> peers;
    DepthTimes depth;  ///< time of finding depth in the frames of "handheld"
    WarpTimes warp;    ///< time of the warp of virtual objects at the video's size
    TriangulationTimes triangulation;
    std::vector<ScalingResult> scaling;
    RenderFigures render;
};

/// Learns filters from the still and frame of each Lesson of a workload, as the daemon does. Prints
/// one line on what was learned to stderr. Returns null if there is no lesson.
[[nodiscard]] std::shared_ptr<const FilterBank> learnedFrom(const Workload& work);

/// Measures all cases. The first frames of each warm up and do not count. The cases "moving" and
/// "rest" use the frames of `moving` without poses. "handheld" uses the frames and poses of
/// `posed`; without frames, this case is left out. Needs a current GL context, which `renderer`
/// describes.
[[nodiscard]] BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                                   EngineKind engine, const std::string& renderer,
                                   const ProgressPart& progress = {});
/// Measures frame times with one and with two threads, each at three output sizes.
[[nodiscard]] std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                                    SuperResMode mode, EngineKind engine,
                                                    const ProgressPart& progress = {});

}  // namespace mfar::bench
