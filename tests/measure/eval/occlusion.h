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
    int frames = 24;
    double noise = 1;  ///< factor of both sensors' noise, see SyntheticOptions
    ProgressPart progress{};
};

/// Measures every object alone in every scene, on every path. Rows are named SCENE/PATH/OBJECT;
/// `method` is the source of the poses. Columns: the times of the stages depth and objects [ms];
/// iou and boundary_px (see OcclusionScore); flicker() of the object's pixels at the output's
/// resolution, measured only on the path `rest`. Throws EvalError, and Failure for a faulty
/// configuration.
[[nodiscard]] Report evaluateOcclusion(const OcclusionRequest& request);

}  // namespace mfar::eval
