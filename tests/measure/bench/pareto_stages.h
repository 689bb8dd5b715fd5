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

/// How a stage is measured: `rounds` rounds, each running every method in turn. All need a current
/// GL context.
struct ParetoRun {
    Clock clock = Clock::Wall;
    int rounds = 3;
    ProgressPart progress{};  ///< what is shown while it runs

    /// The same for one of several samples.
    [[nodiscard]] ParetoRun part(std::size_t index, std::size_t count,
                                 std::string_view name) const {
        return {clock, rounds, progress.part(index, count, name)};
    }
    void showRound(int round) const {
        progress.show(static_cast<std::size_t>(round), static_cast<std::size_t>(rounds) + 1, "");
    }
};

/// Flow of single frames after a new still, against bad-1, with or without poses: every setting of
/// flowKnobs() and combinations, and OpenCV's flow algorithms. With poses, samples without poses
/// are skipped. Empty if no sample remains.
[[nodiscard]] ParetoStage flowStage(const std::vector<CurveSample>& samples, bool withPoses,
                                    const ParetoRun& run);

/// A frame, its still and the true depth. Both have poses.
struct DepthSample {
    CurveSample shots;     ///< without true flow
    cv::Mat inverseDepth;  ///< CV_32F [1/m], NaN = unknown or occluded in the still
};
/// The first `most` samples of each folder that mfar-eval depth accepts. Throws the same
/// exceptions.
[[nodiscard]] std::vector<DepthSample>
depthSamplesOf(const std::vector<std::filesystem::path>& folders, std::size_t most);
/// One frame of each synthetic scene (office, shelf), see syntheticCurveSamples().
[[nodiscard]] std::vector<DepthSample> syntheticDepthSamples(Size video, std::size_t most = 2);

/// Depth of single frames against bad-1; peers: OpenCV's stereo matchers, and triangulation of
/// their flow.
[[nodiscard]] ParetoStage depthStage(const std::vector<DepthSample>& samples, const ParetoRun& run);

/// The frames after a still, some with known truth.
struct SequenceSample {
    Workload work;
    std::vector<cv::Mat>
        truth;  ///< of each frame: luma of the output's size, CV_64F; empty: unknown
};
/// Hand-held sequences of the first `most` synthetic scenes (office, shelf). The truth of every
/// third frame is known.
[[nodiscard]] std::vector<SequenceSample> syntheticSequences(Size video, Size still, int frames,
                                                             std::size_t most = 2);

/// Whole frames against the root mean square error of their luma: the modes, settings of their flow
/// and combinations; peers: bicubic enlargement and the paper's method on OpenCV. The first frame
/// after a still does not count.
[[nodiscard]] ParetoStage superResStage(const std::vector<SequenceSample>& samples,
                                        const ParetoRun& run);

/// A path-traced picture seen from another view, against the error inside the silhouette: methods
/// that fill its holes; peers: OpenCV's inpainting, and tracing the picture again. Throws EvalError
/// if there is no path tracer.
[[nodiscard]] ParetoStage warpStage(bool quick);

/// A path-traced picture after some samples per pixel, in slices of both kinds and as a whole,
/// against its error. Throws as warpStage() does; needs no GL.
[[nodiscard]] ParetoStage slicingStage(bool quick);

/// Settings of superResStage() by name, from which the levels of a quality table are made.
struct QualitySetting {
    std::string name;
    Quality quality;
};
[[nodiscard]] std::vector<QualitySetting> qualitySettings();

}  // namespace mfar::bench
