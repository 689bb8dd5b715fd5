#pragma once

#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A video frame, its reference and the true flow between them: frame(p) looks like still pixel
/// p + truth(p), the still brought to the video's geometry (FlowField in pipeline/results.h).
struct FlowSample {
    std::string frame;                          ///< NN of a pair, <ns>_<ns> of a recording
    std::filesystem::path video, still, truth;  ///< truth: .flo, or .pfm with inverse depth
    Timestamp videoTime, stillTime;
    PosePair poses{};                 ///< recorded
    std::optional<PosePair> given{};  ///< what the shots say instead
};

/// The samples of a folder in the order of their times, with what their pictures have in common.
struct FlowSet {
    StereoRig rig;
    std::vector<FlowSample> samples;
};

/// Either a recording or a folder with flowNN.flo, frameNN.png and the next higher frameMM.png.
///
/// Of a recording, the first of these that is there:
/// 1. truth/flow/<ns>_<ns>.flo from a video frame to a still;
/// 2. truth/inverse_depth of a video frame, when the still that referenceStill() chooses has a
///    known relative pose: a scene at rest;
/// 3. truth/flow from a video frame to another; the rig is then the video camera twice.
/// A still that shows the frame's own view is never used. The rig of a pair is made up: one pinhole
/// for both pictures. Throws EvalError and RecordingError.
[[nodiscard]] FlowSet flowSamplesOf(const std::filesystem::path& folder);

/// Of a recording, 2. alone: every sample's truth is inverse depth and its poses are known.
/// Throws EvalError and RecordingError.
[[nodiscard]] FlowSet depthSamplesOf(const std::filesystem::path& folder);

/// CV_32FC2 [video px] of the video's size, NaN or above 1e9 = unknown.
/// Throws EvalError when the size differs, ImageFileError.
[[nodiscard]] cv::Mat loadTruth(const FlowSet& set, const FlowSample& sample);

/// The pictures, CV_8UC3, with the poses given or else recorded. Throw EvalError when the size is
/// not the rig's, ImageFileError.
[[nodiscard]] Shot loadFrame(const FlowSet& set, const FlowSample& sample);
[[nodiscard]] Shot loadStill(const FlowSet& set, const FlowSample& sample);

}  // namespace mfar::eval
