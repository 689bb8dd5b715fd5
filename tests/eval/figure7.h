#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "tests/eval/picture_metrics.h"
#include "tests/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct Figure7Request {
    std::vector<synthetic::Scene> scenes{synthetic::Scene::Office, synthetic::Scene::Shelf,
                                         synthetic::Scene::Outdoor};
    std::vector<std::filesystem::path> recordings;  ///< with truth/highres
    int frames = 3;                                 ///< of each, at most
    PictureMetrics metrics{{"psnr", "lpc_si", "lpc_si_tiles", "hdrvdp"}, {}};
    std::filesystem::path svg, save;  ///< files of the figure and of the pictures, empty: none
};

/// The methods in the order of the figure; the truth is the first, the product the second.
struct Figure7Method {
    const char* name;   ///< of superResMethodNames(), or "truth"
    const char* title;  ///< in the legend
};
[[nodiscard]] const std::vector<Figure7Method>& figure7Methods();

/// What one scene came to.
struct Figure7Scene {
    std::string name;
    std::vector<std::string> frames;
    std::vector<std::vector<PictureScores>> scores;  ///< of each method, of each frame

    /// Mean over the frames. `value`: of a frame's scores.
    template <class F>
    [[nodiscard]] double mean(std::size_t method, F&& value) const {
        double sum = 0;
        for (const PictureScores& score : scores[method])
            sum += value(score);
        return sum / static_cast<double>(frames.size());
    }
};

/// Figure 7 of the paper again: how near to the truth and how sharp super-resolved frames are, in
/// synthetic scenes (a still every ten frames, the fifth after it measured) and recordings.
/// Throws EvalError and RecordingError.
[[nodiscard]] std::vector<Figure7Scene> evaluateFigure7(const Figure7Request& request);

/// Every frame and method, then the means.
[[nodiscard]] Report figure7Report(const std::vector<Figure7Scene>& scenes,
                                   const PictureMetrics& metrics);
/// A line for each scene: the product against the paper's method, bilinear and the truth.
[[nodiscard]] std::string figure7Summary(const std::vector<Figure7Scene>& scenes);
/// Means as bars, frames as dots, quantiles of the tiles beside LPC-SI.
[[nodiscard]] std::string figure7Svg(const std::vector<Figure7Scene>& scenes,
                                     const PictureMetrics& metrics);

}  // namespace mfar::eval
