#pragma once

#include "base/progress.h"
#include "pipeline/pipeline.h"
#include "tests/measure/bench/depth_bench.h"
#include "tests/measure/bench/objects_bench.h"
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

struct CaseResult {
    std::string name;
    Summary frame;
    std::vector<StageSummary> stages;  ///< measured in a separate run that waits after each stage
    std::array<double, kTileClasses> tileShare{};  ///< share of each TileClass in all tiles
};

/// Times of a peer: the paper's method, built on OpenCV. The peer processed each frame right after
/// mfar.
struct PeerResult {
    std::string name;
    std::string of;  ///< name of the CaseResult with which the peer is compared
    Summary frame;
    /// mfar's median time divided by the peer's; below 1: mfar is faster.
    double ratio = 0;
    double low = 0, high = 0;  ///< 10th and 90th percentile of the ratios of single frames
};

/// Frame times of the cases "moving" and "handheld" for one number of threads and one output size.
struct ScalingResult {
    int threads = 0;
    Size output;
    Summary moving, handheld;
};

struct BenchResult {
    std::string workload;  ///< workload of the cases "moving", "rest" and "rest-noise"
    std::string posed;     ///< workload of the case "handheld"; empty if this case is left out
    std::string renderer;
    Size video, still, output;
    Summary setStill;
    std::vector<CaseResult> cases;
    std::vector<PeerResult> peers;
    DepthTimes depth;
    WarpTimes warp;
    ObjectTimes objects;
    TriangulationTimes triangulation;
    std::vector<ScalingResult> scaling;
    RenderFigures render;
};

/// Learns filters from the lessons of a workload, as the daemon does. Prints a line about them to
/// stderr. Returns null if there is no lesson.
[[nodiscard]] std::shared_ptr<const FilterBank> learnedFrom(const Workload& work);

/// Fills all members of BenchResult but `scaling` and `render`. Before each case, its first
/// frames are run once to warm up; these runs are not counted. "moving", "rest" and "rest-noise"
/// use the frames of `moving` without poses. "handheld" uses frames and poses of `posed`; it is
/// left out if `posed` has no frames. Needs a current GL context, which `renderer` describes.
[[nodiscard]] BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                                   EngineKind engine, const std::string& renderer,
                                   const ProgressPart& progress = {});
/// Measures frame times with one and with two threads, at three output sizes each.
[[nodiscard]] std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                                    SuperResMode mode, EngineKind engine,
                                                    const ProgressPart& progress = {});

}  // namespace mfar::bench
