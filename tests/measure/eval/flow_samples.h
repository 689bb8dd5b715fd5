#pragma once

#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A video frame, its still and the true flow between them: frame(p) looks like still pixel p +
/// truth(p), with the still at the video's geometry (FlowField in pipeline/results.h).
struct FlowSample {
    std::string frame;                          ///< NN of a pair, <ns>_<ns> of a recording
    std::filesystem::path video, still, truth;  ///< truth: .flo, or .pfm with inverse depth
    Timestamp videoTime, stillTime;
    PosePair poses{};                 ///< as recorded
    std::optional<PosePair> given{};  ///< poses from another source, used instead
};

/// The samples of a folder in the order of their times, and what they have in common.
struct FlowSet {
    StereoRig rig;
    std::vector<FlowSample> samples;
};

/// Samples of a recording, or of a folder with flowNN.flo, frameNN.png and the next higher
/// frameMM.png.
///
/// For a recording, the first of these that exists: 1. truth/flow/<ns>_<ns>.flo from a video frame
/// to a still; 2. truth/inverse_depth of a video frame, if the relative pose of the still chosen by
/// referenceStill() is known: a scene at rest; 3. truth/flow from a video frame to another; both
/// cameras of the rig are then the video camera. A still with the frame's own view is never used.
/// The rig of a pair is invented: one pinhole for both pictures. Throws EvalError and
/// RecordingError.
[[nodiscard]] FlowSet flowSamplesOf(const std::filesystem::path& folder);

/// Only case 2 for a recording: every sample's truth is inverse depth and its poses are known.
/// Throws EvalError and RecordingError.
[[nodiscard]] FlowSet depthSamplesOf(const std::filesystem::path& folder);

/// CV_32FC2 [video px] of the video's size, NaN or above 1e9 = unknown. Throws EvalError if the
/// size differs, and ImageFileError.
[[nodiscard]] cv::Mat loadTruth(const FlowSet& set, const FlowSample& sample);

/// The pictures, CV_8UC3, with `given` poses or else the recorded ones. Throw EvalError if the size
/// is not the rig's, and ImageFileError.
[[nodiscard]] Shot loadFrame(const FlowSet& set, const FlowSample& sample);
[[nodiscard]] Shot loadStill(const FlowSet& set, const FlowSample& sample);

}  // namespace mfar::eval
