#pragma once

#include <opencv2/core.hpp>

#include <array>

namespace mfar::eval {

/// Ratio of a filter's spread to its centre frequency, in the authors' release 1.0 and in another
/// version in circulation. The other version gives higher values, which must not be compared with
/// values of the release.
inline constexpr double kLpcRelease = 0.75, kLpcVariant = 0.33;

struct LpcOrientation {
    std::array<double, 3> filterSum{};  ///< sum of the filter's gains at each scale, finest first
    /// Mean and standard deviation of the finest scale's amplitudes, without border.
    double mean = 0, deviation = 0;
    double threshold = 0;                 ///< mean + 2 deviation; smaller amplitudes do not count
    double energy = 0;                    ///< sum of max(amplitude - threshold, 0), whole picture
    std::array<double, 2> coarserMean{};  ///< mean amplitude at the coarser scales, whole picture
};

struct LpcSharpness {
    double index = 0;                ///< LPC-SI, [0, 1); larger is sharper
    double mapMax = 0, mapMean = 0;  ///< maximum and mean of eq. 33 over all pixels but the border
    std::array<LpcOrientation, 8> orientations{};
};

/// Local phase coherence sharpness index (Hassen, Wang, Salama 2013, eqs. 21 to 35), as in the
/// authors' release 1.0. The sharpest ten-thousandth of the pixels determines it, so one sharp
/// patch makes a whole picture count as sharp; lpcTiles() avoids this. `picture`: CV_64F in grey
/// levels [0, 255], at least 32x32. Throws std::invalid_argument for other pictures and for values
/// that are not finite. Only one thread may call it at a time.
[[nodiscard]] LpcSharpness lpcSharpness(const cv::Mat& picture, double sigmaRatio = kLpcRelease);
[[nodiscard]] double lpcSi(const cv::Mat& picture, double sigmaRatio = kLpcRelease);

/// Quantiles of lpcSi() over the tiles of a grid that divides the picture into 8 x 8 equal parts.
/// lpcSi() is computed for each tile separately.
struct LpcTiles {
    double p10 = 0, median = 0, p90 = 0;
};
inline constexpr int kLpcTiles = 8;
inline constexpr int kLpcSmallestSide = 32;  ///< smallest side of a picture or tile [px]
[[nodiscard]] LpcTiles lpcTiles(const cv::Mat& picture, double sigmaRatio = kLpcRelease);

}  // namespace mfar::eval
