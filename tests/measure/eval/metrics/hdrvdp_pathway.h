#pragma once

#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <opencv2/core.hpp>

namespace mfar::eval::hdrvdp {

/// A picture after the eye's optics and receptors, CV_64F of the picture's size.
struct Pathway {
    cv::Mat adaptation;  ///< luminance to which each pixel is adapted [cd/m^2]
    cv::Mat achromatic;  ///< response of cones and rods together, minus its mean [JND]
};
struct Pathways {
    Pathway test, reference;
};

/// Applies the eye's optics and receptors to both pictures, which hold light as in hdrVdp().
[[nodiscard]] Pathways pathways(const cv::Mat& test, const cv::Mat& reference,
                                double pixelsPerDegree,
                                Emission emission = Emission::FluorescentLcd);

}  // namespace mfar::eval::hdrvdp
