#pragma once

#include "base/progress.h"
#include "tests/measure/bench/curve_samples.h"

#include <string>
#include <vector>

namespace mfar::bench {

/// Time and error of a flow method at one value of a knob (an option that trades time for error).
/// Other options keep their defaults. Numbers are means over the samples.
struct CurvePoint {
    double value = 0;
    bool isDefault = false;
    double ms = 0;    ///< time of the flow, median of three runs
    double epe = 0;   ///< end-point error [px]
    double bad1 = 0;  ///< see FlowError::bad1
};

struct Curve {
    std::string method;
    std::string knob;
    std::vector<CurvePoint> points;
};

/// One of OpenCV's flow algorithms, measured on the same samples as the curves. It computes only
/// the flow from the frame to the still.
struct CurvePeer {
    std::string name;
    CurvePoint point;
};

struct Curves {
    std::vector<std::string> samples;
    std::vector<Curve> curves;
    std::vector<CurvePeer> peers;
};

/// Measures every knob of the flow on all samples. Knobs of the epipolar search need samples with
/// poses. flow2d computes both directions, as in mfard, but starts without the last frame's
/// flow. Setting a still is not timed. Needs a current GL context. Throws std::invalid_argument if
/// there are no samples.
[[nodiscard]] Curves measureCurves(const std::vector<CurveSample>& samples,
                                   const ProgressPart& progress = {});

}  // namespace mfar::bench
