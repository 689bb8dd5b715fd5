#pragma once

#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// A bar with its label. If `value` is not finite, the text "not measured" replaces the bar.
struct Bar {
    std::string label;
    double value = 0;
    std::vector<double> dots{};  ///< further values, for example those whose mean is `value`
    std::size_t colour = 0;
};

struct BarPanel {
    std::string title;
    std::vector<Bar> bars;
    int decimals = 2;
};

/// Draws panels of horizontal bars as one SVG document. The axis begins at 0, unless all values of
/// a panel lie close together and far from 0. Then the axis begins near the values, and points
/// replace the bars, because bars that do not begin at 0 mislead.
[[nodiscard]] std::string barsSvg(const std::string& title, const std::vector<BarPanel>& panels,
                                  const std::string& footnote);

/// Makes a panel for each measured column of a report. A bar is the mean of a method. Dots are the
/// means of the recordings or, with only one recording, the values of its frames. In a report
/// without means, each row gives a bar.
[[nodiscard]] std::vector<BarPanel> barsOf(const Report& report);

struct SizedSvg {
    std::string svg;
    double width = 0, height = 0;
};

[[nodiscard]] std::string gridSvg(const std::string& title, const std::vector<SizedSvg>& parts,
                                  std::size_t columns, const std::string& footnote);

}  // namespace mfar::eval
