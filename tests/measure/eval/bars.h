#pragma once

#include "tests/measure/eval/report.h"

#include <string>
#include <vector>

namespace mfar::eval {

/// A bar with its label. If `value` is NaN, it was not measured.
struct Bar {
    std::string label;
    double value = 0;
    std::vector<double> dots{};  ///< single values behind the mean, e.g. of frames
    std::size_t colour = 0;      ///< index into svg::kColours
};

/// A chart of horizontal bars.
struct BarPanel {
    std::string title;  ///< name of the value, with its unit
    std::vector<Bar> bars;
    int decimals = 2;
};

/// Draws panels of horizontal bars as one SVG document. The axis of a panel begins at 0. If all its
/// values lie close together and far from 0, the axis begins near them, and they are drawn as
/// points, because the length of a bar would mean nothing.
[[nodiscard]] std::string barsSvg(const std::string& title, const std::vector<BarPanel>& panels,
                                  const std::string& footnote);

/// Makes a panel for each measured column of a report. Each method's mean is a bar. The dots are
/// the means of the recordings or, if there is only one recording, the values of its frames.
[[nodiscard]] std::vector<BarPanel> barsOf(const Report& report);

/// An SVG document and its size [px].
struct SizedSvg {
    std::string svg;
    double width = 0, height = 0;
};

/// Puts SVG documents side by side in rows, as one document. Each is drawn at its own size.
[[nodiscard]] std::string gridSvg(const std::string& title, const std::vector<SizedSvg>& parts,
                                  std::size_t columns, const std::string& footnote);

}  // namespace mfar::eval
