#pragma once

#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A video frame, its still and the true flow between them. The still is resampled to the video's
/// geometry; then pixel p of the frame and pixel p + truth(p) of the still show the same point.
struct FlowSample {
    std::string frame;  ///< number NN of a pair, or times <ns>_<ns> of a recording
    std::filesystem::path video, still, truth;  ///< `truth`: .flo, or .pfm with inverse depth
    Timestamp videoTime, stillTime;
    PosePair poses{};
    std::optional<PosePair> given{};  ///< if set, methods get these poses, not `poses`
};

struct FlowSet {
    StereoRig rig;
    std::vector<FlowSample> samples;
};

/// Finds the samples of a recording, or of a folder with pairs of frames. The flow of a pair,
/// flowNN.flo, leads from frameNN.png to the frame with the next higher number. Both frames of a
/// pair get the same pinhole camera. Stills for which showsOwnView() is true are not used. Throws
/// EvalError, RecordingError and ImageFileError.
///
/// The truth of a recording is the first that exists of: 1. truth/flow/<ns>_<ns>.flo from a video
/// frame to a still; 2. truth/inverse_depth of a video frame in a scene at rest, if the pose
/// relative to the still of referenceStill() is known; 3. truth/flow between two video frames, of
/// which the second serves as the still (both cameras are then the video camera).
[[nodiscard]] FlowSet flowSamplesOf(const std::filesystem::path& folder);

/// Finds samples as flowSamplesOf() does, but uses only truth/inverse_depth with known poses.
[[nodiscard]] FlowSet depthSamplesOf(const std::filesystem::path& folder);

/// Returns CV_32FC2 [video px] at the video's size; NaN or above 1e9: unknown. Throws EvalError if
/// the size differs, and ImageFileError.
[[nodiscard]] cv::Mat loadTruth(const FlowSet& set, const FlowSample& sample);

/// Load a picture as CV_8UC3, with its pose from sample.given or, if that is empty, the recorded
/// pose. Throw ImageFileError, and EvalError if a picture does not have the rig's size.
[[nodiscard]] Shot loadFrame(const FlowSet& set, const FlowSample& sample);
[[nodiscard]] Shot loadStill(const FlowSet& set, const FlowSample& sample);

}  // namespace mfar::eval
