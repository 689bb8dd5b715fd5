#pragma once

#include "pipeline/geometry.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// Two pictures and the true flow between them: a(p) looks like b(p + truth(p)).
struct FlowSample {
    std::string frame;  ///< NN of a pair, <ns>_<ns> of a recording
    std::filesystem::path a, b, truth;
    std::optional<StereoRig> rig = std::nullopt;  ///< set: b is a still, to be brought to the video
};

/// The samples of a folder. Either a recording with truth/flow/<ns>_<ns>.flo from a video frame to
/// a still (or, where no still has that time, to another video frame), or a folder with flowNN.flo,
/// frameNN.png and the next higher frameMM.png. Throws EvalError and RecordingError.
[[nodiscard]] std::vector<FlowSample> flowSamplesOf(const std::filesystem::path& folder);

/// Pictures of a sample, CV_8UC1 of one size, and its truth, CV_32FC2 of that size.
struct FlowPictures {
    cv::Mat a, b, truth;
};

/// Throws EvalError when the sizes differ, ImageFileError.
[[nodiscard]] FlowPictures loadFlowPictures(const FlowSample& sample);

}  // namespace mfar::eval
