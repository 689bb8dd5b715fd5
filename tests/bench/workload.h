#pragma once

#include "pipeline/geometry.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar::bench {

/// The pictures a benchmark runs on, all in memory. CV_8UC3, B G R.
struct Workload {
    std::string name;
    StereoRig rig;
    std::vector<cv::Mat> stills;
    std::vector<cv::Mat> frames;
    std::vector<std::size_t> stillOf;  ///< per frame: index of its reference
};

/// A textured plane made in code, seen by a hand-held camera: each frame differs from the one
/// before by some 4 video pixels, a little rotation and sensor noise. One still, taken before.
/// Repeatable.
[[nodiscard]] Workload syntheticWorkload(Size video, Size still, int frames);

/// Frames of a recording, from its start and round again when it is short, with the stills that
/// mfar-eval would use. Throws EvalError and RecordingError.
[[nodiscard]] Workload recordedWorkload(const std::filesystem::path& folder, int frames);

/// The first frame over and over: a camera at rest. With `noise`, a sensor's noise of that sigma
/// [grey levels] changes every pixel every time.
[[nodiscard]] Workload atRest(const Workload& moving, double noise);

}  // namespace mfar::bench
