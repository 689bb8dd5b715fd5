#pragma once

#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <opencv2/core.hpp>

namespace mfar::eval::hdrvdp {

/// A picture after the eye's stages that precede the spatial channels. CV_64F of the picture's
/// size.
struct Pathway {
    cv::Mat adaptation;  ///< luminance to which each pixel is adapted [cd/m^2]
    cv::Mat achromatic;  ///< response of cones and rods together, less its mean [JND]
};
struct Pathways {
    Pathway test, reference;
};

/// Optics, photoreceptors and their sum, for both pictures; light as in hdrVdp().
[[nodiscard]] Pathways pathways(const cv::Mat& test, const cv::Mat& reference,
                                double pixelsPerDegree,
                                Emission emission = Emission::FluorescentLcd);

}  // namespace mfar::eval::hdrvdp
