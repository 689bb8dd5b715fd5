#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A point of a plot. It is not drawn if a value is not finite or if x is not above 0.
struct PlotPoint {
    double x = 0, y = 0;
    std::string tip;    ///< tool tip
    std::string label;  ///< text next to the point
};

struct PlotLine {
    std::string legend;
    std::vector<PlotPoint> points;
};

/// A panel with two logarithmic axes that span all points, and the lines between the points.
struct PlotPanel {
    std::string title, xLabel, yLabel;
    double leastY = 1e-9;  ///< smaller y are drawn here, because 0 has no logarithm
    std::vector<PlotLine> lines;
    std::vector<PlotPoint> diamonds;
    std::optional<PlotPoint> ringed;
};

/// An SVG document with the panels side by side. Its colours can be told apart with any colour
/// vision.
[[nodiscard]] std::string plotSvg(const std::string& title, const std::vector<PlotPanel>& panels,
                                  const std::string& footnote);

}  // namespace mfar::eval
