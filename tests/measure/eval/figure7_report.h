#pragma once

#include "tests/measure/eval/picture_metrics.h"
#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// The methods in the order of the figure: the truth is the first, the product the second.
struct Figure7Method {
    const char* name;   ///< one of superResMethodNames(), or "truth"
    const char* title;  ///< its name in the legend
};
[[nodiscard]] const std::vector<Figure7Method>& figure7Methods();

/// Results of one scene.
struct Figure7Scene {
    std::string name;
    std::vector<std::string> frames;
    std::vector<std::vector<PictureScores>> scores;  ///< indexed by method, then by frame

    /// Mean over the frames. `value` returns a score of one frame.
    template <class F>
    [[nodiscard]] double mean(std::size_t method, F&& value) const {
        double sum = 0;
        for (const PictureScores& score : scores[method])
            sum += value(score);
        return sum / static_cast<double>(frames.size());
    }
};

/// One row per frame and method, then the means.
[[nodiscard]] Report figure7Report(const std::vector<Figure7Scene>& scenes,
                                   const PictureMetrics& metrics);
/// One line per scene that compares the product with the paper's method, bilinear and the truth.
[[nodiscard]] std::string figure7Summary(const std::vector<Figure7Scene>& scenes);
/// Bars show the means, dots the frames. For LPC-SI, lines show the quantiles over the tiles.
[[nodiscard]] std::string figure7Svg(const std::vector<Figure7Scene>& scenes,
                                     const PictureMetrics& metrics);

}  // namespace mfar::eval
