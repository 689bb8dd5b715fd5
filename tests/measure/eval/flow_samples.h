#pragma once

#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A video frame, its still and the true flow between them. Video pixel p looks like still pixel p
/// + truth(p) after the still is resampled to the video's geometry (see FlowField in
/// pipeline/results.h).
struct FlowSample {
    std::string frame;                          ///< NN for a pair, <ns>_<ns> for a recording
    std::filesystem::path video, still, truth;  ///< truth: .flo, or .pfm with inverse depth
    Timestamp videoTime, stillTime;
    PosePair poses{};                 ///< poses of the recording
    std::optional<PosePair> given{};  ///< poses from another source; they replace `poses`
};

/// The samples of a folder, ordered by time, and their common properties.
struct FlowSet {
    StereoRig rig;
    std::vector<FlowSample> samples;
};

/// Finds the samples of a recording, or of a folder with flowNN.flo, frameNN.png and the
/// frameMM.png with the next higher number. Throws EvalError and RecordingError.
///
/// A recording may have truth of three kinds; the first that exists is used. 1.
/// truth/flow/<ns>_<ns>.flo from a video frame to a still. 2. truth/inverse_depth of a video frame,
/// for a scene at rest: the still is chosen by referenceStill(), and their relative pose must be
/// known. 3. truth/flow from one video frame to another: the second frame serves as the still, and
/// both cameras of the rig are the video camera.
///
/// A still with the frame's own view is never used. The rig of a pair is assumed: one pinhole for
/// both pictures.
[[nodiscard]] FlowSet flowSamplesOf(const std::filesystem::path& folder);

/// Like flowSamplesOf(), but for recordings with truth of kind 2 only: every sample has true
/// inverse depth, and its poses are known. Throws EvalError and RecordingError.
[[nodiscard]] FlowSet depthSamplesOf(const std::filesystem::path& folder);

/// CV_32FC2 [video px] of the video's size, NaN or above 1e9 = unknown. Throws EvalError if the
/// size differs, and ImageFileError.
[[nodiscard]] cv::Mat loadTruth(const FlowSet& set, const FlowSample& sample);

/// Load the pictures, CV_8UC3, with the pose in `given` if there is one, otherwise with the
/// recorded pose. Throw ImageFileError, and EvalError if a picture does not have the rig's size.
[[nodiscard]] Shot loadFrame(const FlowSet& set, const FlowSample& sample);
[[nodiscard]] Shot loadStill(const FlowSet& set, const FlowSample& sample);

}  // namespace mfar::eval
