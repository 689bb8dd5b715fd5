#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar {
class FilterBank;
class SyntheticBoard;
}  // namespace mfar

namespace mfar::bench {

/// A still, and a frame that the product matched with it.
struct Lesson {
    cv::Mat still, frame;
    std::optional<Pose> stillPose{}, framePose{};
};

/// The pictures a benchmark runs on, all in memory. CV_8UC3, B G R.
struct Workload {
    std::string name;
    StereoRig rig;
    std::vector<cv::Mat> stills;
    std::vector<cv::Mat> frames;
    std::vector<std::size_t> stillOf;  ///< per frame: index of its reference
    /// Of the video camera, per frame and per still; nothing where not known, empty: of none.
    std::vector<std::optional<Pose>> framePoses{}, stillPoses{};
    std::vector<Lesson> lessons{};  ///< what the product has learned from before the frames
    std::shared_ptr<const FilterBank> filters{};  ///< from these; null: as shipped
};

/// As a running product has: pairs of stills are among them.
inline constexpr int kLessons = 4;

/// A textured plane made in code, seen by a hand-held camera: each frame differs from the one
/// before by some 4 video pixels, a little rotation and sensor noise. One still, taken before.
/// Repeatable.
[[nodiscard]] Workload syntheticWorkload(Size video, Size still, int frames, int lessons = 0);

/// The synthetic board's office through a hand-held camera, with exact poses: one still, then
/// frames. The board's pictures are brought to the sizes asked for. Needs no current GL context.
/// Repeatable.
[[nodiscard]] Workload handheldWorkload(Size video, Size still, int frames, int lessons = 0);
/// The same of any board of Pace::Consumer that has not been started.
[[nodiscard]] Workload handheldWorkload(SyntheticBoard& board, Size video, Size still, int frames,
                                        int lessons = 0);

/// Frames of a recording, from its start and round again when it is short, with the stills that
/// mfar-eval would use, and their poses. Each still with its first frame is a lesson. Throws
/// EvalError and RecordingError.
[[nodiscard]] Workload recordedWorkload(const std::filesystem::path& folder, int frames);

/// The first frame over and over: a camera at rest. With `noise`, a sensor's noise of that sigma
/// [grey levels] changes every pixel every time.
[[nodiscard]] Workload atRest(const Workload& moving, double noise);

}  // namespace mfar::bench
