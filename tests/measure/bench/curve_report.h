#pragma once

#include "tests/measure/bench/curves.h"

#include <filesystem>
#include <string>

namespace mfar::bench {

/// Columns: method,knob,value,default,ms,epe_px,bad1. In rows of peers, knob, value and default are
/// empty.
[[nodiscard]] std::string curvesCsv(const Curves& curves);

/// Chart with logarithmic axes: time on x, bad-1 on y. Each method has a panel and each knob a
/// line. A ring marks the point where all knobs have their defaults.
[[nodiscard]] std::string curvesSvg(const Curves& curves);

/// Writes curves.csv and curves.svg into `folder`. Throws EvalError if this fails.
void writeCurves(const Curves& curves, const std::filesystem::path& folder);

}  // namespace mfar::bench
