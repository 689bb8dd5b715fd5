#pragma once

#include "tests/measure/eval/metrics/hdrvdp_model.h"

#include <opencv2/core.hpp>

#include <vector>

namespace mfar::eval {

struct HdrVdpDisplay {
    double peak = 100, black = 1;  ///< luminance of white and of black [cd/m^2]
    double gamma = 2.2;            ///< used for grey pictures; colour pictures are always sRGB
    double pixelsPerDegree = 30;
};

/// Pixels per degree at the centre of a screen. `diagonal` in inches, `distance` in m.
[[nodiscard]] double pixelsPerDegree(double diagonal, cv::Size resolution, double distance);

/// Light that a display emits for a picture [cd/m^2]. The picture is CV_64F or CV_64FC3 (B G R,
/// sRGB) in [0, 255]; the result has the same type. Throws std::invalid_argument for values outside
/// this range, and for an impossible display, such as one whose black is brighter than its white.
[[nodiscard]] cv::Mat displayedLight(const cv::Mat& picture, const HdrVdpDisplay& display);

/// Contribution of one orientation of one band of the steerable pyramid. D: masked difference of
/// the pictures.
struct HdrVdpBand {
    int band = 1, orientation = 1;
    cv::Size size;
    double frequency = 0;  ///< spatial frequency of the band [cycles/degree]
    double weight = 0;     ///< weight in the quality score of release 2.2.2
    /// sqrt(sum of D^2 where the pictures differ) / (number of all pixels of the band).
    double error = 0;
    double sumAbsolute = 0;
    double meanReference = 0, meanTest = 0;  ///< mean absolute band value of each picture
    double meanSensitivity = 0, meanSelfMask = 0, meanMasking = 0;
};

struct HdrVdpResult {
    double q = 0;     ///< score of releases 2.2.1 and 2.2.2; 100: equal pictures; no lower bound
    double q220 = 0;  ///< mean of weight * log(error) over the bands; gives Q_MOS of release 2.2.0
    double qMos = 0;  ///< Q_MOS of release 2.2.0, [0, 100]
    std::vector<HdrVdpBand> bands;
};

/// Quality of a picture against a reference, predicted by HDR-VDP-2 (Mantiuk et al. 2011; weights
/// of Narwaria et al. 2015), with the constants of releases 2.2.x and a dark surround (1e-5
/// cd/m^2). Q is smaller for more pixels per degree, and larger for larger pictures. So compare
/// only values of pictures with equal size and equal pixels per degree.
///
/// Both pictures hold light [cd/m^2] as from displayedLight(): CV_64F, or CV_64FC3 (B G R of
/// `emission`), same size, at least 17x17. Throws std::invalid_argument for other pictures, and for
/// light or pixels per degree that are not finite and positive. Only one thread may call it at a
/// time.
[[nodiscard]] HdrVdpResult hdrVdp(const cv::Mat& test, const cv::Mat& reference,
                                  double pixelsPerDegree,
                                  hdrvdp::Emission emission = hdrvdp::Emission::FluorescentLcd);

}  // namespace mfar::eval
