#pragma once

#include "base/progress.h"
#include "hal/virtual/synthetic_scene.h"
#include "tests/measure/eval/pose_source.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct OcclusionRequest {
    std::vector<synthetic::Scene> scenes{synthetic::Scene::Office, synthetic::Scene::Shelf};
    std::vector<synthetic::Path> paths{synthetic::Path::Handheld, synthetic::Path::Rest};
    std::filesystem::path objects;  ///< configuration file of mfard; empty: sceneObjects()
    PoseSource poses = PoseSource::Recorded;
    int frames = 24;          ///< scored frames per run
    double noise = 1;         ///< sensor noise of both sensors, see SyntheticOptions
    ProgressPart progress{};  ///< shows the progress while the command runs
};

/// Measures every object alone in every scene, on every path. A row is named SCENE/PATH/OBJECT; its
/// `method` is the source of the poses. Columns: ms, the time of the stages depth and composite;
/// iou and boundary_px, see OcclusionScore; flicker with the camera at rest, as a share of the
/// object's pixels at the output's resolution. Means and medians follow the rows. Throws EvalError,
/// and Failure for a faulty configuration.
[[nodiscard]] Report evaluateOcclusion(const OcclusionRequest& request);

}  // namespace mfar::eval
