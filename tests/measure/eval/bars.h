#pragma once

#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// A bar with its label; NaN: not measured.
struct Bar {
    std::string label;
    double value = 0;
    std::vector<double> dots{};  ///< single values, for instance of frames
    std::size_t colour = 0;      ///< index into svg::kColours
};

struct BarPanel {
    std::string title;  ///< with the unit
    std::vector<Bar> bars;
    int decimals = 2;
};

/// Panels of horizontal bars as one SVG document. The axis of a panel begins at 0, unless all its
/// values lie close together far from 0: these are drawn as points, because the length of a bar
/// would mean nothing.
[[nodiscard]] std::string barsSvg(const std::string& title, const std::vector<BarPanel>& panels,
                                  const std::string& footnote);

/// A panel of each measured column of a report: a bar of each method's mean, dots of recordings or,
/// if there is only one, of its frames.
[[nodiscard]] std::vector<BarPanel> barsOf(const Report& report);

/// SVG documents side by side in rows, as one document. Each is drawn at its own size.
struct SizedSvg {
    std::string svg;
    double width = 0, height = 0;
};
[[nodiscard]] std::string gridSvg(const std::string& title, const std::vector<SizedSvg>& parts,
                                  std::size_t columns, const std::string& footnote);

}  // namespace mfar::eval
