#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A point of a plot. It is drawn if x and y are finite, x is above 0 and y is not negative.
struct PlotPoint {
    double x = 0, y = 0;
    std::string tip;
    std::string label;
};

struct PlotLine {
    std::string legend;
    std::vector<PlotPoint> points;
};

struct PlotPanel {
    std::string title, xLabel, yLabel;
    double leastY = 1e-9;  ///< smaller y are drawn at this value, because 0 has no logarithm
    std::vector<PlotLine> lines;
    std::vector<PlotPoint> diamonds;
    std::optional<PlotPoint> ringed;
};

/// Draws panels side by side as an SVG document, in colours that can be told apart with any colour
/// vision.
[[nodiscard]] std::string plotSvg(const std::string& title, const std::vector<PlotPanel>& panels,
                                  const std::string& footnote);

}  // namespace mfar::eval
