#pragma once

#include "tests/measure/eval/scene_run.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::bench {

/// A frame and the still that precedes it, R G B A, rendered before anything is timed: the board's
/// renderer uses threads of this program.
struct SceneFrame {
    cv::Mat picture, still;  ///< still: empty if there is none
    Timestamp time;
    std::optional<Pose> pose, stillPose;
};

/// The next frame of a scene.
[[nodiscard]] SceneFrame nextFrame(eval::SceneRun& scene);

}  // namespace mfar::bench
