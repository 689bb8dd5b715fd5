#pragma once

#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <opencv2/core.hpp>

namespace mfar::eval::hdrvdp {

/// What the eye makes of a picture before its spatial channels. CV_64F of the picture's size.
struct Pathway {
    cv::Mat adaptation;  ///< luminance that each place is adapted to [cd/m^2]
    cv::Mat achromatic;  ///< response of cones and rods together, less its mean [JND]
};
struct Pathways {
    Pathway test, reference;
};

/// Optics, photoreceptors and their sum, of both pictures; light as hdrVdp() takes it.
[[nodiscard]] Pathways pathways(const cv::Mat& test, const cv::Mat& reference,
                                double pixelsPerDegree,
                                Emission emission = Emission::FluorescentLcd);

}  // namespace mfar::eval::hdrvdp
