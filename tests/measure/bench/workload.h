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

/// The input of a benchmark, all in memory. CV_8UC3, B G R.
struct Workload {
    std::string name;
    StereoRig rig;
    std::vector<cv::Mat> stills;
    std::vector<cv::Mat> frames;
    std::vector<std::size_t> stillOf;  ///< per frame: index of its still
    /// Poses of the video camera, per frame and per still. An entry is empty if unknown; the vector
    /// is empty if all are.
    std::vector<std::optional<Pose>> framePoses{}, stillPoses{};
    std::vector<Lesson> lessons{};  ///< pairs from which the product learned before the frames
    std::shared_ptr<const FilterBank> filters{};  ///< learned from the lessons; null: default
                                                  ///< filters
};

/// Enough for pairs of stills among the lessons, as in a running product.
inline constexpr int kLessons = 4;

/// A synthetic textured plane seen by a hand-held camera: consecutive frames differ by about 4
/// video pixels, a small rotation and sensor noise. One still, taken before the frames. Repeatable.
[[nodiscard]] Workload syntheticWorkload(Size video, Size still, int frames, int lessons = 0);

/// The synthetic board's office through a hand-held camera, with exact poses: one still, then
/// frames, resized to the requested sizes. Needs no current GL context. Repeatable.
[[nodiscard]] Workload handheldWorkload(Size video, Size still, int frames, int lessons = 0);
/// The same for any board of Pace::Consumer that has not been started.
[[nodiscard]] Workload handheldWorkload(SyntheticBoard& board, Size video, Size still, int frames,
                                        int lessons = 0);

/// Frames of a recording, repeated from its start if it is too short, with the stills that
/// mfar-eval would use, and their poses. Each still with its first frame is a lesson. Throws
/// EvalError and RecordingError.
[[nodiscard]] Workload recordedWorkload(const std::filesystem::path& folder, int frames);

/// Repeats the first frame: a camera at rest. `noise`: sigma of sensor noise that changes in every
/// frame [grey levels].
[[nodiscard]] Workload atRest(const Workload& moving, double noise);

}  // namespace mfar::bench
