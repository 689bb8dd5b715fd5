#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mfar {

struct ChartLine {
    std::string name;
    std::vector<double> y;  ///< one value for each x of the chart; NaN makes a gap
};

/// A chart of lines that share their values of x. Both axes are linear.
struct LineChart {
    std::string title, xLabel;
    std::vector<double> x;  ///< in ascending order
    std::vector<ChartLine> lines{};
    bool fills = false;  ///< shades the area between the first two lines
    /// Upper end of the vertical axis. Not set: the axis ends just above the lines and the rule.
    std::optional<double> mostY{};
    std::optional<ChartLine> rule{};  ///< a dashed horizontal line at y[0]
};

/// Draws the chart as an SVG element of 460x210 px. The vertical axis begins at 0, or at the lowest
/// value if that is negative.
[[nodiscard]] std::string chartSvg(const LineChart& chart);

[[nodiscard]] std::vector<double> linearTicks(double least, double most, int count);

}  // namespace mfar
