#pragma once

#include "tests/measure/bench/curves.h"

#include <filesystem>
#include <string>

namespace mfar::bench {

/// One line per value of a knob: method,knob,value,default,ms,epe_px,bad1. For peers, knob and
/// value are empty.
[[nodiscard]] std::string curvesCsv(const Curves& curves);

/// The same values as a chart with logarithmic axes: time on x, bad-1 on y. Each method has a
/// panel, each knob a line whose ends are labelled. The default setting is ringed. Both panels show
/// the peers.
[[nodiscard]] std::string curvesSvg(const Curves& curves);

/// Writes curves.csv and curves.svg. Throws EvalError if they cannot be written.
void writeCurves(const Curves& curves, const std::filesystem::path& folder);

}  // namespace mfar::bench
