#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar {
class SyntheticBoard;
}

namespace mfar::bench {

/// The pictures a benchmark runs on, all in memory. CV_8UC3, B G R.
struct Workload {
    std::string name;
    StereoRig rig;
    std::vector<cv::Mat> stills;
    std::vector<cv::Mat> frames;
    std::vector<std::size_t> stillOf;  ///< per frame: index of its reference
    /// Of the video camera, per frame and per still; nothing where not known, empty: of none.
    std::vector<std::optional<Pose>> framePoses{}, stillPoses{};
};

/// A textured plane made in code, seen by a hand-held camera: each frame differs from the one
/// before by some 4 video pixels, a little rotation and sensor noise. One still, taken before.
/// Repeatable.
[[nodiscard]] Workload syntheticWorkload(Size video, Size still, int frames);

/// The synthetic board's office through a hand-held camera, with exact poses: one still, then
/// frames. The board's pictures are brought to the sizes asked for. Needs no current GL context.
/// Repeatable.
[[nodiscard]] Workload handheldWorkload(Size video, Size still, int frames);
/// The same of any board of Pace::Consumer that has not been started.
[[nodiscard]] Workload handheldWorkload(SyntheticBoard& board, Size video, Size still, int frames);

/// Frames of a recording, from its start and round again when it is short, with the stills that
/// mfar-eval would use, and their poses. Throws EvalError and RecordingError.
[[nodiscard]] Workload recordedWorkload(const std::filesystem::path& folder, int frames);

/// The first frame over and over: a camera at rest. With `noise`, a sensor's noise of that sigma
/// [grey levels] changes every pixel every time.
[[nodiscard]] Workload atRest(const Workload& moving, double noise);

}  // namespace mfar::bench
