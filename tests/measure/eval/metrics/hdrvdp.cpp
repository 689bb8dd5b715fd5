#include "tests/measure/eval/metrics/hdrvdp.h"

#include "tests/measure/eval/metrics/hdrvdp_bands.h"
#include "tests/measure/eval/metrics/hdrvdp_pathway.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mfar::eval {
namespace {

constexpr double kSrgbLinear = 0.04045;

double srgbDecoded(double v) {
    return v <= kSrgbLinear ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

void requireLight(const cv::Mat& light) {
    if (light.depth() != CV_64F || (light.channels() != 1 && light.channels() != 3))
        throw std::invalid_argument("HDR-VDP-2: light must be CV_64F of one or three channels");
    if (light.cols < 17 || light.rows < 17)
        throw std::invalid_argument("HDR-VDP-2: pictures must have 17x17 pixels at least");
    if (!cv::checkRange(light, true, nullptr, 1e-12, 1e10))
        throw std::invalid_argument("HDR-VDP-2: light must be finite and positive");
}

/// Returns 1 for pixels at which the pictures differ by more than a thousandth of the reference,
/// otherwise 0.
cv::Mat differs(const cv::Mat& test, const cv::Mat& reference) {
    cv::Mat out(test.size(), CV_64F);
    const int channels = test.channels();
    for (int y = 0; y < out.rows; ++y) {
        const auto *t = test.ptr<double>(y), *r = reference.ptr<double>(y);
        for (int x = 0; x < out.cols; ++x) {
            bool is = false;
            for (int i = channels * x; i < channels * (x + 1); ++i)
                is = is || std::abs(t[i] - r[i]) / r[i] > 0.001;
            out.at<double>(y, x) = is ? 1 : 0;
        }
    }
    return out;
}

}  // namespace

double pixelsPerDegree(double diagonal, cv::Size resolution, double distance) {
    const double aspect = static_cast<double>(resolution.width) / resolution.height;
    const double height = 25.4 * diagonal / std::sqrt(1 + aspect * aspect);  // [mm]
    const double angle = 2 * std::atan(height / (2000 * distance));
    return resolution.height / (angle * 180 / std::numbers::pi);
}

cv::Mat displayedLight(const cv::Mat& picture, const HdrVdpDisplay& display) {
    if (!(display.black > 0 && display.peak > display.black && display.peak < 1e5))
        throw std::invalid_argument(
            "a display's black must be brighter than 0, and its white brighter than its black "
            "and below 100000 cd/m2");
    if (!(display.gamma > 0 && display.gamma < 10))
        throw std::invalid_argument("a display's gamma must be in (0, 10)");
    if (picture.depth() != CV_64F || !cv::checkRange(picture, true, nullptr, 0, 255 + 1e-9))
        throw std::invalid_argument("grey levels must be CV_64F in [0, 255]");
    const bool grey = picture.channels() == 1;
    cv::Mat out = picture.clone();
    cv::parallel_for_({0, out.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y) {
            auto* v = out.ptr<double>(y);
            for (int i = 0; i < out.cols * out.channels(); ++i)
                v[i] = display.black +
                       (display.peak - display.black) *
                           (grey ? std::pow(v[i] / 255, display.gamma) : srgbDecoded(v[i] / 255));
        }
    });
    return out;
}

HdrVdpResult hdrVdp(const cv::Mat& test, const cv::Mat& reference, double pixelsPerDegree,
                    hdrvdp::Emission emission) {
    requireLight(test);
    requireLight(reference);
    if (test.type() != reference.type() || test.size() != reference.size())
        throw std::invalid_argument("HDR-VDP-2: both pictures must have the same size and type");
    if (!(pixelsPerDegree > 0 && pixelsPerDegree < 1e4))
        throw std::invalid_argument("HDR-VDP-2: pixels per degree must be in (0, 10000)");
    const cv::Mat mask = differs(test, reference);
    hdrvdp::BandComparison comparison(hdrvdp::pathways(test, reference, pixelsPerDegree, emission),
                                      pixelsPerDegree);
    HdrVdpResult out;
    out.bands = comparison.compare(mask);
    constexpr double kEps = 1e-12;
    out.q = 100;
    for (const HdrVdpBand& band : out.bands) {
        const double log = std::log(band.error + kEps);
        out.q -= band.weight * (log - std::log(kEps));
        out.q220 += hdrvdp::qualityWeight220(band.frequency) * log;
    }
    out.q220 /= static_cast<double>(out.bands.size());
    out.qMos = 100 / (1 + std::exp(3.455 * (out.q220 + 0.8886)));
    return out;
}

}  // namespace mfar::eval
