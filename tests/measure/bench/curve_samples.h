#pragma once

#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::bench {

struct CurveSample {
    std::string name;
    StereoRig rig;
    eval::Shot frame, still;
    cv::Mat truth;  ///< true flow, CV_32FC2 [video px]; NaN or above 1e9: unknown

    [[nodiscard]] bool hasPoses() const { return frame.pose && still.pose; }
};

/// Loads at most `most` samples from each folder. A folder is a recording or contains pairs of
/// frames with their flow, see eval::flowSamplesOf(). Throws EvalError, RecordingError and
/// ImageFileError.
[[nodiscard]] std::vector<CurveSample>
curveSamplesOf(const std::vector<std::filesystem::path>& folders, std::size_t most);

/// One frame of a hand-held camera in each of the first `most` synthetic scenes (office, shelf).
/// `video`: size of the video, at most 640x480. Repeated calls give equal samples.
[[nodiscard]] std::vector<CurveSample> syntheticCurveSamples(Size video, std::size_t most = 2);

}  // namespace mfar::bench
