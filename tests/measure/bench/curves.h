#pragma once

#include "base/progress.h"
#include "tests/measure/bench/curve_samples.h"

#include <string>
#include <vector>

namespace mfar::bench {

/// Time and error of a flow method at one value of a knob (an option that trades time for error).
/// All other options have their defaults.
struct CurvePoint {
    double value = 0;
    bool isDefault = false;
    double ms = 0;    ///< run time: median of three runs, mean over the samples
    double epe = 0;   ///< end-point error, mean over the samples [px]
    double bad1 = 0;  ///< share of the known pixels with an error above 1 px, mean over the samples
};

/// The values of one knob in ascending order.
struct Curve {
    std::string method;  ///< flow2d or epipolar
    std::string knob;    ///< member of Flow2dOptions or EpipolarOptions
    std::vector<CurvePoint> points;
};

/// One of OpenCV's flow algorithms, computed in one direction, on the samples of the curves.
struct CurvePeer {
    std::string name;
    CurvePoint point;
};

struct Curves {
    std::vector<std::string> samples;  ///< names of the samples
    std::vector<Curve> curves;
    std::vector<CurvePeer> peers;
};

/// Measures every knob of the flow on every sample. Knobs of the epipolar search are measured only
/// if poses are known. As in the product, flow2d computes both directions, but it starts without
/// the field of the last frame. Work per still is not timed. Needs a current GL context. Throws
/// std::invalid_argument if there are no samples.
[[nodiscard]] Curves measureCurves(const std::vector<CurveSample>& samples,
                                   const ProgressPart& progress = {});

}  // namespace mfar::bench
