#pragma once

#include "pipeline/quality.h"
#include "tests/measure/bench/clock.h"
#include "tests/measure/bench/curve_samples.h"
#include "tests/measure/bench/pareto.h"
#include "tests/measure/bench/workload.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::bench {

/// How a stage is measured: every way in turn, so many rounds of them. All need a current GL
/// context.
struct ParetoRun {
    Clock clock = Clock::Wall;
    int rounds = 3;
};

/// The flow of single frames against bad-1, with poses or without, from a new still on: every
/// setting of flowKnobs() and combinations, and OpenCV's flows. Samples without poses are left out
/// where those are used. Empty when none is left.
[[nodiscard]] ParetoStage flowStage(const std::vector<CurveSample>& samples, bool withPoses,
                                    const ParetoRun& run);

/// A frame, its still and the true depth. Both have poses.
struct DepthSample {
    CurveSample shots;     ///< without flow
    cv::Mat inverseDepth;  ///< CV_32F [1/m], NaN = unknown or hidden in the still
};
/// Of the folders that mfar-eval depth takes, the first `most` samples. Throws as it does.
[[nodiscard]] std::vector<DepthSample>
depthSamplesOf(const std::vector<std::filesystem::path>& folders, std::size_t most);
/// A frame each of the synthetic office and shelf, as syntheticCurveSamples().
[[nodiscard]] std::vector<DepthSample> syntheticDepthSamples(Size video, std::size_t most = 2);

/// Depth of single frames against bad-1, and OpenCV's stereo matchers with the triangulation of
/// their flow.
[[nodiscard]] ParetoStage depthStage(const std::vector<DepthSample>& samples, const ParetoRun& run);

/// Frames after a still, with what some of them should look like.
struct SequenceSample {
    Workload work;
    std::vector<cv::Mat>
        truth;  ///< luma of the output's size, CV_64F, of each frame; empty: unknown
};
/// The first `most` of the synthetic office and shelf, hand-held. Every third frame's truth is
/// known.
[[nodiscard]] std::vector<SequenceSample> syntheticSequences(Size video, Size still, int frames,
                                                             std::size_t most = 2);

/// Whole frames against the root mean square error of their luma: the modes, settings of their flow
/// and combinations, and bicubic enlargement and the paper's method on OpenCV. The first frame
/// after a still does not count.
[[nodiscard]] ParetoStage superResStage(const std::vector<SequenceSample>& samples,
                                        const ParetoRun& run);

/// A path-traced picture seen from elsewhere against the error inside the silhouette: what fills
/// its holes, with OpenCV's inpainting and a picture that is traced anew. Throws EvalError where
/// there is no path tracer.
[[nodiscard]] ParetoStage warpStage(bool quick);

/// A path-traced picture after some samples a pixel, in slices of both kinds and as a whole,
/// against its error. Throws as warpStage(); needs no GL.
[[nodiscard]] ParetoStage slicingStage(bool quick);

/// Settings of superResStage() by their names: what the levels of a quality table are made of.
struct QualitySetting {
    std::string name;
    Quality quality;
};
[[nodiscard]] std::vector<QualitySetting> qualitySettings();

}  // namespace mfar::bench
