#pragma once

#include "tests/measure/eval/picture_metrics.h"
#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// The methods in the order of the figure: the truth first, the product second.
struct Figure7Method {
    const char* name;   ///< of superResMethodNames(), or "truth"
    const char* title;  ///< in the legend
};
[[nodiscard]] const std::vector<Figure7Method>& figure7Methods();

/// Results of one scene.
struct Figure7Scene {
    std::string name;
    std::vector<std::string> frames;
    std::vector<std::vector<PictureScores>> scores;  ///< by method, then by frame

    /// Mean over the frames. `value`: selects a score of a frame.
    template <class F>
    [[nodiscard]] double mean(std::size_t method, F&& value) const {
        double sum = 0;
        for (const PictureScores& score : scores[method])
            sum += value(score);
        return sum / static_cast<double>(frames.size());
    }
};

/// All frames and methods, then the means.
[[nodiscard]] Report figure7Report(const std::vector<Figure7Scene>& scenes,
                                   const PictureMetrics& metrics);
/// One line per scene that compares the product with the paper's method, bilinear and the truth.
[[nodiscard]] std::string figure7Summary(const std::vector<Figure7Scene>& scenes);
/// Means as bars, frames as dots; for LPC-SI also quantiles of the tiles.
[[nodiscard]] std::string figure7Svg(const std::vector<Figure7Scene>& scenes,
                                     const PictureMetrics& metrics);

}  // namespace mfar::eval
