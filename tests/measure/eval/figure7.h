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
    std::vector<std::filesystem::path> recordings;  ///< with truth/highres
    int frames = 3;                                 ///< per recording or scene, at most
    int learn = 0;  ///< stills per scene from which the product learns before; 0: default filters
    PictureMetrics metrics{{"psnr", "lpc_si", "lpc_si_tiles", "hdrvdp"}, {}};
    std::filesystem::path svg, save;  ///< files for the figure and the pictures; empty: not written
    ProgressPart progress{};          ///< what is shown while it runs
};

/// Reproduces Figure 7 of the paper: accuracy and sharpness of super-resolved frames, in synthetic
/// scenes (a still every ten frames; the fifth frame after it is measured; frames for learning come
/// before) and in recordings. Throws EvalError and RecordingError.
[[nodiscard]] std::vector<Figure7Scene> evaluateFigure7(const Figure7Request& request);

}  // namespace mfar::eval
