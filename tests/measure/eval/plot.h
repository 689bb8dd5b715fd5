#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A value over another. Points that are not finite or, for x, not above 0 are left out.
struct PlotPoint {
    double x = 0, y = 0;
    std::string tip;    ///< shown where the mouse rests
    std::string label;  ///< written beside it
};

struct PlotLine {
    std::string legend;
    std::vector<PlotPoint> points;
};

/// Two logarithmic axes over all of its points, and what lies between them.
struct PlotPanel {
    std::string title, xLabel, yLabel;
    double leastY = 1e-9;  ///< what is drawn for anything below, as a logarithm ends somewhere
    std::vector<PlotLine> lines;
    std::vector<PlotPoint> diamonds;
    std::optional<PlotPoint> ringed;
};

/// An SVG document of panels side by side, in colours distinct for every kind of colour vision.
[[nodiscard]] std::string plotSvg(const std::string& title, const std::vector<PlotPanel>& panels,
                                  const std::string& footnote);

/// Throws EvalError when the file cannot be written.
void writePlot(const std::filesystem::path& file, const std::string& svg);

}  // namespace mfar::eval
