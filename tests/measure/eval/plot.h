#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A point of a plot. Points that are not finite or, for x, not above 0 are left out.
struct PlotPoint {
    double x = 0, y = 0;
    std::string tip;    ///< tool tip
    std::string label;  ///< text next to the point
};

struct PlotLine {
    std::string legend;
    std::vector<PlotPoint> points;
};

/// Two logarithmic axes over all points, and the lines between them.
struct PlotPanel {
    std::string title, xLabel, yLabel;
    double leastY = 1e-9;  ///< lower limit of what is drawn, because the axis is logarithmic
    std::vector<PlotLine> lines;
    std::vector<PlotPoint> diamonds;
    std::optional<PlotPoint> ringed;
};

/// An SVG document of panels side by side, in colours that are distinct for all kinds of colour
/// vision.
[[nodiscard]] std::string plotSvg(const std::string& title, const std::vector<PlotPanel>& panels,
                                  const std::string& footnote);

}  // namespace mfar::eval
