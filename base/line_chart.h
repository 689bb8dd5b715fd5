#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// A line of a chart.
struct ChartLine {
    std::string name;       ///< for the legend
    std::vector<double> y;  ///< one for each x of the chart; NaN: a gap
};

/// Lines over a common axis; both axes are linear.
struct LineChart {
    std::string title, xLabel;
    std::vector<double> x;  ///< ascending
    std::vector<ChartLine> lines{};
    bool fills = false;               ///< the area between the first two lines is shaded
    std::optional<double> mostY{};    ///< upper end of the axis; nothing: by the lines
    std::optional<ChartLine> rule{};  ///< a dashed horizontal line at y[0]
};

/// An SVG element of 460x210 px. The vertical axis begins at 0, or below if a line does.
[[nodiscard]] std::string chartSvg(const LineChart& chart);

/// Round values from 0 or `least` to `most`, about `count` of them.
[[nodiscard]] std::vector<double> linearTicks(double least, double most, int count);

}  // namespace mfar
