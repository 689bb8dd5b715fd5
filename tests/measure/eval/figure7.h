#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "tests/measure/eval/figure7_report.h"

#include <filesystem>
#include <vector>

namespace mfar::eval {

struct Figure7Request {
    std::vector<synthetic::Scene> scenes{synthetic::Scene::Office, synthetic::Scene::Shelf,
                                         synthetic::Scene::Outdoor};
    std::vector<std::filesystem::path> recordings;  ///< with truth/highres
    int frames = 3;                                 ///< of each, at most
    int learn = 0;  ///< stills of each that the product learns from before; 0: filters as shipped
    PictureMetrics metrics{{"psnr", "lpc_si", "lpc_si_tiles", "hdrvdp"}, {}};
    std::filesystem::path svg, save;  ///< files of the figure and of the pictures, empty: none
};

/// Figure 7 of the paper again: how near to the truth and how sharp super-resolved frames are, in
/// synthetic scenes (a still every ten frames, the fifth after it measured; the frames that are
/// learned from come before) and recordings.
/// Throws EvalError and RecordingError.
[[nodiscard]] std::vector<Figure7Scene> evaluateFigure7(const Figure7Request& request);

}  // namespace mfar::eval
