#pragma once

#include "base/geometry.h"
#include "hal/virtual/synthetic_board.h"

#include <opencv2/core.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar {
class FilterBank;
}  // namespace mfar

namespace mfar::bench {

/// A still and a frame that was matched with it, from which mfar learns filters.
struct Lesson {
    cv::Mat still, frame;
    std::optional<Pose> stillPose{}, framePose{};
};

/// The input of a benchmark. All pictures are loaded or rendered before the measurement; CV_8UC3,
/// B G R.
struct Workload {
    std::string name;
    StereoRig rig;
    std::vector<cv::Mat> stills;
    std::vector<cv::Mat> frames;
    std::vector<std::size_t> stillOf;  ///< for each frame, the index of its still in `stills`
    /// Poses of the video camera at each frame and at each still. An unknown pose is an empty
    /// entry. If all are unknown, the vector may be empty.
    std::vector<std::optional<Pose>> framePoses{}, stillPoses{};
    /// The still before the first one, with its frame. Like a running mfard, the pipeline uses it
    /// where the newest still shows nothing. In a recording, it is the last other still.
    std::optional<Lesson> before{};
    std::vector<Lesson> lessons{};  ///< pairs from which filters are learned before the first frame
    std::shared_ptr<const FilterBank> filters{};  ///< learned from `lessons`; null: shipped filters
};

/// Number of lessons in benchmarks. Learning guidance needs at least two stills.
inline constexpr int kLessons = 4;

/// Synthetic textured plane seen by a hand-held camera, with one still before the frames.
/// Consecutive frames differ by up to 5 video pixels at 640x480, a small rotation and sensor noise.
/// Repeated calls give equal pictures.
[[nodiscard]] Workload syntheticWorkload(Size video, Size still, int frames, int lessons = 0);

/// Options of a board whose camera is hand-held and whose sensors have these picture sizes. Sizes
/// smaller than the defaults take less time to render.
[[nodiscard]] SyntheticOptions handheldOptions(synthetic::Scene scene, Size video, Size still);

/// The synthetic board's office seen by a hand-held camera, with exact poses: one still, then
/// frames, resized to the given sizes. `lessons`: number of entries of Workload::lessons. Needs no
/// current GL context. Repeated calls give equal pictures.
[[nodiscard]] Workload handheldWorkload(Size video, Size still, int frames, int lessons = 0);
/// Gets the pictures from `board`, which must have Pace::Consumer and must not have been started.
[[nodiscard]] Workload handheldWorkload(SyntheticBoard& board, Size video, Size still, int frames,
                                        int lessons = 0);

/// Frames of a recording with poses and with the stills that mfar-eval would use. A short recording
/// starts again from its first frame. A lesson is a still with the first frame that uses it. Throws
/// EvalError, RecordingError and ImageFileError.
[[nodiscard]] Workload recordedWorkload(const std::filesystem::path& folder, int frames);

/// Repeats the first frame of `moving`, as a camera at rest would see it. `noise`: standard
/// deviation of added sensor noise, which differs in every frame [grey levels].
[[nodiscard]] Workload atRest(const Workload& moving, double noise);

}  // namespace mfar::bench
