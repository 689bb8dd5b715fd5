#pragma once

#include "base/progress.h"
#include "hal/virtual/synthetic_scene.h"
#include "tests/measure/eval/figure7_report.h"

#include <filesystem>
#include <vector>

namespace mfar::eval {

struct Figure7Request {
    std::vector<synthetic::Scene> scenes{synthetic::Scene::Office, synthetic::Scene::Shelf,
                                         synthetic::Scene::Outdoor};
    std::vector<std::filesystem::path> recordings;
    int frames = 3;  ///< largest number of frames per recording or scene
    /// Number of stills per scene or recording from which filters are learned; 0: shipped filters.
    int learn = 0;
    PictureMetrics metrics{{"psnr", "lpc_si", "lpc_si_tiles", "hdrvdp"}, {}};
    std::filesystem::path svg, save;
    ProgressPart progress{};
};

/// Repeats Figure 7 of the paper: accuracy and sharpness of super-resolved frames in synthetic
/// scenes and recordings. A synthetic scene begins with the frames for learning. Then a still is
/// requested every ten frames, and the fifth frame after each request is measured. Throws
/// EvalError, RecordingError and ImageFileError.
[[nodiscard]] std::vector<Figure7Scene> evaluateFigure7(const Figure7Request& request);

}  // namespace mfar::eval
