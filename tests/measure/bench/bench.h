#pragma once

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
    std::vector<StageSummary> stages;  ///< in a run of its own: each stage waits for its end
    std::array<double, kTileClasses> tileShare{};  ///< mean share of the tiles per TileClass
};

/// OpenCV's version of the paper on a moving camera, frame by frame in turn with ours.
struct PeerResult {
    std::string name;
    std::string of;  ///< the case of ours
    Summary frame;
    double ratio = 0;          ///< our median over the peer's: below 1 we are faster
    double low = 0, high = 0;  ///< 10th and 90th percentile of the ratio frame by frame
};

/// Moving frames with another number of threads or output size.
struct ScalingResult {
    int threads = 0;
    Size output;
    Summary moving, handheld;
};

struct BenchResult {
    std::string workload;  ///< what is moving and at rest
    std::string posed;     ///< what is hand-held
    std::string renderer;
    Size video, still, output;
    Summary setStill;  ///< per-still work of our pipeline
    std::vector<CaseResult> cases;
    std::vector<PeerResult> peers;
    DepthTimes depth;  ///< of what is hand-held
    WarpTimes warp;    ///< at the video's size
    TriangulationTimes triangulation;
    std::vector<ScalingResult> scaling;
    RenderFigures render;
};

/// Filters learned from a workload's lessons as the daemon learns them; null: there are none. One
/// line on what was learned goes to stderr.
[[nodiscard]] std::shared_ptr<const FilterBank> learnedFrom(const Workload& work);

/// Needs a current GL context, which `renderer` describes. The first frames warm up and do not
/// count. Poses of `moving` are not used, those of `posed` are; without frames it is left out.
[[nodiscard]] BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                                   EngineKind engine, const std::string& renderer);
/// One thread and two, at three output sizes.
[[nodiscard]] std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                                    SuperResMode mode, EngineKind engine);

}  // namespace mfar::bench
