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

/// How a stage is measured: in `rounds` rounds, each of which runs every method once. All functions
/// below that take it need a current GL context.
struct ParetoRun {
    Clock clock = Clock::Wall;
    int rounds = 3;
    ProgressPart progress{};  ///< shows the progress while the command runs

    /// Returns a copy of this run that shows the progress of sample `index` of `count`.
    [[nodiscard]] ParetoRun part(std::size_t index, std::size_t count,
                                 std::string_view name) const {
        return {clock, rounds, progress.part(index, count, name)};
    }
    void showRound(int round) const {
        progress.show(static_cast<std::size_t>(round), static_cast<std::size_t>(rounds) + 1, "");
    }
};

/// Run time and bad-1 of the flow of single frames after a new still. Methods: every setting of
/// flowKnobs(), combinations of settings, and OpenCV's flow algorithms. With poses, samples without
/// poses are skipped. The stage is empty if no sample remains.
[[nodiscard]] ParetoStage flowStage(const std::vector<CurveSample>& samples, bool withPoses,
                                    const ParetoRun& run);

/// A frame, its still and the true depth. Frame and still have poses.
struct DepthSample {
    CurveSample shots;     ///< its true flow is not set
    cv::Mat inverseDepth;  ///< CV_32F [1/m], NaN = unknown or occluded in the still
};
/// The first `most` samples of each folder that mfar-eval depth accepts. Throws EvalError,
/// RecordingError and ImageFileError.
[[nodiscard]] std::vector<DepthSample>
depthSamplesOf(const std::vector<std::filesystem::path>& folders, std::size_t most);
/// One frame of each synthetic scene (office, shelf), see syntheticCurveSamples().
[[nodiscard]] std::vector<DepthSample> syntheticDepthSamples(Size video, std::size_t most = 2);

/// Run time and bad-1 of the depth of single frames. Peers: OpenCV's stereo matchers, and
/// triangulation of the flow of OpenCV's flow algorithms.
[[nodiscard]] ParetoStage depthStage(const std::vector<DepthSample>& samples, const ParetoRun& run);

/// The frames after a still. The truth of some of them is known.
struct SequenceSample {
    Workload work;
    std::vector<cv::Mat>
        truth;  ///< of each frame: luma of the output's size, CV_64F; empty: unknown
};
/// Hand-held sequences of the first `most` synthetic scenes (office, shelf). The truth of every
/// third frame is known.
[[nodiscard]] std::vector<SequenceSample> syntheticSequences(Size video, Size still, int frames,
                                                             std::size_t most = 2);

/// Run time of whole frames and the root mean square error of their luma. Methods: the
/// super-resolution modes, settings of their flow, and combinations of both. Peers: bicubic
/// enlargement, and the paper's method with OpenCV's flow. The first frame after a still does not
/// count.
[[nodiscard]] ParetoStage superResStage(const std::vector<SequenceSample>& samples,
                                        const ParetoRun& run);

/// Run time of warping a path-traced picture to another view, and the error inside the silhouette
/// of the objects. Methods: the ways to fill the holes. Peers: OpenCV's inpainting, and tracing the
/// picture again.
/// Throws EvalError if the path tracer is not built.
[[nodiscard]] ParetoStage warpStage(bool quick);

/// Run time and error of a path-traced picture after some samples per pixel. The picture is traced
/// in time slices, in spatial slices, and as a whole. Throws EvalError if the path tracer is not
/// built. Needs no GL context.
[[nodiscard]] ParetoStage slicingStage(bool quick);

/// A setting that superResStage() measures, with its name. Levels of a quality table are made from
/// such settings.
struct QualitySetting {
    std::string name;
    Quality quality;
};
[[nodiscard]] std::vector<QualitySetting> qualitySettings();

}  // namespace mfar::bench
