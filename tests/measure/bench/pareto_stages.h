#pragma once

#include "base/progress.h"
#include "pipeline/quality.h"
#include "tests/measure/bench/clock.h"
#include "tests/measure/bench/curve_samples.h"
#include "tests/measure/bench/pareto.h"
#include "tests/measure/bench/workload.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::bench {

/// Options of a measurement. Each round runs every method once. Functions that take a ParetoRun
/// need a current GL context.
struct ParetoRun {
    Clock clock = Clock::Wall;
    int rounds = 3;
    ProgressPart progress{};

    [[nodiscard]] ParetoRun part(std::size_t index, std::size_t count,
                                 std::string_view name) const {
        return {clock, rounds, progress.part(index, count, name)};
    }
    void showRound(int round) const {
        progress.show(static_cast<std::size_t>(round), static_cast<std::size_t>(rounds) + 1, "");
    }
};

/// Run time and bad-1 (share of pixels with an error above 1 px) of the flow of single frames. Each
/// frame is the first one after a new still. Methods: every setting of flowKnobs(), combinations of
/// settings, and OpenCV's flow algorithms. If `withPoses` is true, OpenCV's stereo matchers are
/// measured, too, and samples without poses are skipped; if no sample remains, the stage has no
/// points.
[[nodiscard]] ParetoStage flowStage(const std::vector<CurveSample>& samples, bool withPoses,
                                    const ParetoRun& run);

/// A frame, its still and the true depth. Frame and still have poses.
struct DepthSample {
    CurveSample shots;
    cv::Mat inverseDepth;  ///< CV_32F [1/m]; NaN: unknown, or occluded in the still
};
/// Loads at most `most` samples from each folder, as mfar-eval depth does. Throws EvalError,
/// RecordingError and ImageFileError.
[[nodiscard]] std::vector<DepthSample>
depthSamplesOf(const std::vector<std::filesystem::path>& folders, std::size_t most);
/// One frame of each synthetic scene, as in syntheticCurveSamples().
[[nodiscard]] std::vector<DepthSample> syntheticDepthSamples(Size video, std::size_t most = 2);

/// Run time and bad-1 of the depth of single frames. bad-1 is the share of pixels whose disparity
/// is wrong by more than 1 px. Peers: mfar's flow, triangulated by the paper's midpoint method, and
/// OpenCV's stereo matchers.
[[nodiscard]] ParetoStage depthStage(const std::vector<DepthSample>& samples, const ParetoRun& run);

struct SequenceSample {
    Workload work;
    std::vector<cv::Mat> truth;  ///< luma at the output's size, CV_64F; empty: unknown
};
/// Sequences of a hand-held camera in the first `most` synthetic scenes (office, shelf). The true
/// picture of every third frame is known.
[[nodiscard]] std::vector<SequenceSample> syntheticSequences(Size video, Size still, int frames,
                                                             std::size_t most = 2);

/// Run time of whole frames and RMS error of their luma. Methods: super-resolution modes, settings
/// of their flow, and combinations. Peers: bicubic enlargement, and the paper's method with
/// OpenCV's flow. The time of the first frame after a still is not counted.
[[nodiscard]] ParetoStage superResStage(const std::vector<SequenceSample>& samples,
                                        const ParetoRun& run);

/// Run time of warping a path-traced picture to another view, and the error inside the objects'
/// silhouette. Methods: the ways to fill pixels without a rendered sample. Peers: OpenCV's
/// inpainting, and tracing the picture again. Throws EvalError if the path tracer is not built.
[[nodiscard]] ParetoStage warpStage(bool quick);

/// Run time and error of a path-traced picture after 1, 2, 4, ... samples per pixel. It is traced
/// in time slices, in spatial slices, or as a whole. Throws EvalError if the path tracer is not
/// built. Needs no GL context.
[[nodiscard]] ParetoStage slicingStage(bool quick);

struct QualitySetting {
    std::string name;
    Quality quality;
};
[[nodiscard]] std::vector<QualitySetting> qualitySettings();

}  // namespace mfar::bench
