#pragma once

#include "base/progress.h"
#include "tests/measure/bench/curve_samples.h"

#include <string>
#include <vector>

namespace mfar::bench {

/// Time and error of one value of a knob; all other settings are the defaults.
struct CurvePoint {
    double value = 0;
    bool isDefault = false;
    double ms = 0;    ///< mean over the samples of the median of three runs
    double epe = 0;   ///< mean over the samples [px]
    double bad1 = 0;  ///< likewise, share of the known pixels with an error above 1 px
};

/// The values of one knob in ascending order.
struct Curve {
    std::string method;  ///< flow2d or epipolar
    std::string knob;    ///< member of Flow2dOptions or EpipolarOptions
    std::vector<CurvePoint> points;
};

/// One of OpenCV's flow algorithms, in one direction, on the same samples.
struct CurvePeer {
    std::string name;
    CurvePoint point;
};

struct Curves {
    std::vector<std::string> samples;  ///< names
    std::vector<Curve> curves;
    std::vector<CurvePeer> peers;
};

/// Measures every knob of the flow on every sample; knobs of the epipolar search only if poses are
/// known. Needs a current GL context. flow2d computes both directions, as in the product, and
/// starts without the last frame's field; work per still is not timed. Throws std::invalid_argument
/// without samples.
[[nodiscard]] Curves measureCurves(const std::vector<CurveSample>& samples,
                                   const ProgressPart& progress = {});

}  // namespace mfar::bench
