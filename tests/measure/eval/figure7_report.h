#pragma once

#include "tests/measure/eval/picture_metrics.h"
#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// A method of the figure. In figure7Methods(), the first is the truth and the second is mfar.
struct Figure7Method {
    const char* name;
    const char* title;
};
[[nodiscard]] const std::vector<Figure7Method>& figure7Methods();

struct Figure7Scene {
    std::string name;
    std::vector<std::string> frames;
    std::vector<std::vector<PictureScores>> scores;  ///< indexed by method, then by frame

    template <class F>
    [[nodiscard]] double mean(std::size_t method, F&& value) const {
        double sum = 0;
        for (const PictureScores& score : scores[method])
            sum += value(score);
        return sum / static_cast<double>(frames.size());
    }
};

[[nodiscard]] Report figure7Report(const std::vector<Figure7Scene>& scenes,
                                   const PictureMetrics& metrics);
[[nodiscard]] std::string figure7Summary(const std::vector<Figure7Scene>& scenes);
[[nodiscard]] std::string figure7Svg(const std::vector<Figure7Scene>& scenes,
                                     const PictureMetrics& metrics);

}  // namespace mfar::eval
