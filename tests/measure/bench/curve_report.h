#pragma once

#include "tests/measure/bench/curves.h"

#include <filesystem>
#include <string>

namespace mfar::bench {

/// One line per value of a knob: method,knob,value,default,ms,epe_px,bad1. Peers have neither knob
/// nor value.
[[nodiscard]] std::string curvesCsv(const Curves& curves);

/// The same as a picture: time across, bad-1 upwards, both logarithmic; a panel for each method, a
/// line for each knob with its ends named, the default ringed, the peers in both.
[[nodiscard]] std::string curvesSvg(const Curves& curves);

/// curves.csv and curves.svg. Throws EvalError when they cannot be written.
void writeCurves(const Curves& curves, const std::filesystem::path& folder);

}  // namespace mfar::bench
