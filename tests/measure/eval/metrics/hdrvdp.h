#pragma once

#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <opencv2/core.hpp>

#include <vector>

namespace mfar::eval {

/// What a picture is seen on.
struct HdrVdpDisplay {
    double peak = 100, black = 1;  ///< luminance of white and of black [cd/m^2]
    double gamma = 2.2;            ///< of grey pictures; colours are sRGB
    double pixelsPerDegree = 30;   ///< of the visual field
};

/// Pixels per degree of a screen seen from its middle: diagonal [inches], distance [m].
[[nodiscard]] double pixelsPerDegree(double diagonal, cv::Size resolution, double distance);

/// The light that a display shows for a picture [cd/m^2]: CV_64F or CV_64FC3 (B G R, sRGB) in grey
/// levels, [0, 255] -> the same type. Throws std::invalid_argument for values outside and for a
/// display that cannot be.
[[nodiscard]] cv::Mat displayedLight(const cv::Mat& picture, const HdrVdpDisplay& display);

/// One orientation of one band of the pyramid, both pictures taken together.
struct HdrVdpBand {
    int band = 1, orientation = 1;  ///< counted from 1
    cv::Size size;
    double frequency = 0;  ///< [cycles/degree]
    double weight = 0;     ///< in the quality of 2.2.2
    double error = 0;      ///< root of the summed squares of D where the pictures differ, per pixel
    double sumAbsolute = 0;                  ///< of D, the masked difference
    double meanReference = 0, meanTest = 0;  ///< of absolute band values
    double meanSensitivity = 0, meanSelfMask = 0, meanMasking = 0;
};

struct HdrVdpResult {
    double q = 0;     ///< of releases 2.2.1 and 2.2.2: 100 = no difference, no lower bound
    double q220 = 0;  ///< the sum that release 2.2.0 makes its Q_MOS of
    double qMos = 0;  ///< of release 2.2.0, [0, 100]
    std::vector<HdrVdpBand> bands;
};

/// Quality of a picture against a reference as HDR-VDP-2 predicts it (Mantiuk et al. 2011; weights
/// of Narwaria et al. 2015), with the constants and the dark surround (1e-5 cd/m^2) of releases
/// 2.2.x. Q falls with the pixels per degree and rises with the size: compare it at one of each.
///
/// Both pictures: light [cd/m^2], CV_64F, or CV_64FC3 (B G R of `emission`), same size, at least
/// 17x17; as displayedLight() gives it. Throws std::invalid_argument for others, for light that is
/// not finite and positive, and for pixels per degree that are not. From one thread at a time.
[[nodiscard]] HdrVdpResult hdrVdp(const cv::Mat& test, const cv::Mat& reference,
                                  double pixelsPerDegree,
                                  hdrvdp::Emission emission = hdrvdp::Emission::FluorescentLcd);

}  // namespace mfar::eval
