#pragma once

#include "tests/measure/bench/curves.h"

#include <filesystem>
#include <string>

namespace mfar::bench {

/// One line per value of a knob: method,knob,value,default,ms,epe_px,bad1. For peers, knob and
/// value are empty.
[[nodiscard]] std::string curvesCsv(const Curves& curves);

/// The same as a chart: time on x, bad-1 on y, both logarithmic; a panel for each method, a line
/// for each knob with its ends labelled, the default ringed, the peers in both panels.
[[nodiscard]] std::string curvesSvg(const Curves& curves);

/// Writes curves.csv and curves.svg. Throws EvalError if they cannot be written.
void writeCurves(const Curves& curves, const std::filesystem::path& folder);

}  // namespace mfar::bench
