#include "tests/measure/eval/metrics/hdrvdp_bands.h"

#include "tests/measure/eval/metrics/bicubic_resize.h"
#include "tests/measure/eval/metrics/hdrvdp_model.h"
#include "tests/measure/eval/metrics/radial_filter.h"
#include "tests/measure/eval/metrics/steerable_filters.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mfar::eval::hdrvdp {
namespace {

constexpr int kLeastSide = 17;  // smaller pictures are not divided into bands
int levelsOf(cv::Size size) {
    int out = 0;
    for (; size.width >= kLeastSide && size.height >= kLeastSide; ++out)
        size = {size.width / 2, size.height / 2};
    return out;
}

double meanAbsolute(const cv::Mat& values) {
    return cv::norm(values, cv::NORM_L1) / static_cast<double>(values.total());
}

cv::Mat logOfMean(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat out = (a + b) / 2;
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x)
            out.at<double>(y, x) = std::log10(std::clamp(out.at<double>(y, x), 1e-5, 1e5));
    return out;
}

/// One row of a band. `self` is the mask of the same orientation, `others` is that of the band's
/// other orientations, and `beside` is that of the adjacent bands. `sensitivity` is null for the
/// base (the coarsest picture of the pyramid), because addBase() has already applied it.
struct BandRow {
    const double *difference, *self, *others, *beside, *sensitivity, *weight;
};

cv::Vec3d comparedRow(const BandRow& row, int cols, double norm) {
    const Masking& by = masking();
    cv::Vec3d sum;
    for (int x = 0; x < cols; ++x) {
        const double noise = row.sensitivity ? 1 / row.sensitivity[x] : 1;
        const double mask =
            norm * (by.self * std::pow(row.self[x] / (noise * norm), by.maskExponent) +
                    by.orientations * std::pow(row.others[x] / (noise * norm), by.maskExponent) +
                    by.neighbours * std::pow(row.beside[x] / noise, by.maskExponent));
        const double signal =
            norm * std::pow(std::abs(row.difference[x]) / norm, by.signalExponent);
        const double floor = std::pow(noise, by.signalExponent);
        const double visible = signal / std::sqrt(floor * floor + mask * mask);
        sum += cv::Vec3d(visible * visible * row.weight[x] * row.weight[x], visible, mask);
    }
    return sum;
}

}  // namespace

BandComparison::BandComparison(Pathways pathways, double pixelsPerDegree)
    : pixelsPerDegree_(pixelsPerDegree),
      logLuminance_(logOfMean(pathways.test.adaptation, pathways.reference.adaptation)) {
    decompose(std::move(pathways));
}

void BandComparison::add(Band& band, const cv::Mat& test, const cv::Mat& reference) {
    band.meanTest.push_back(meanAbsolute(test));
    band.meanReference.push_back(meanAbsolute(reference));
    band.difference.emplace_back(test - reference);
    cv::Mat mask;
    cv::min(cv::Mat(cv::abs(test)), cv::Mat(cv::abs(reference)), mask);
    cv::boxFilter(mask, mask, -1, {3, 3}, {-1, -1}, true,
                  cv::BORDER_CONSTANT | cv::BORDER_ISOLATED);
    band.mutualMask.push_back(std::move(mask));
}

void BandComparison::decompose(Pathways pathways) {
    const double testLuminance = cv::mean(pathways.test.adaptation)[0];
    const double referenceLuminance = cv::mean(pathways.reference.adaptation)[0];
    const SteerableFilters filters = steerableFilters();
    cv::Mat test = std::move(pathways.test.achromatic);
    cv::Mat reference = std::move(pathways.reference.achromatic);
    const int levels = levelsOf(test.size());
    bands_.resize(static_cast<std::size_t>(levels) + 2);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        bands_[b].norm = std::pow(2, b);
        bands_[b].frequency = pixelsPerDegree_ / 2 / bands_[b].norm;
    }
    add(bands_[0], correlate(test, filters.highPass), correlate(reference, filters.highPass));
    test = correlate(test, filters.firstLowPass);
    reference = correlate(reference, filters.firstLowPass);
    for (int level = 1; level <= levels; ++level) {
        for (const cv::Mat& taps : filters.orientation)
            add(bands_[static_cast<std::size_t>(level)], correlate(test, taps),
                correlate(reference, taps));
        test = correlate(test, filters.lowPass, 2);
        reference = correlate(reference, filters.lowPass, 2);
    }
    addBase(test, reference, testLuminance, referenceLuminance);
}

// The base covers so many frequencies that one sensitivity for all of them would be too inexact. So
// a filter applies to each frequency its own sensitivity.
void BandComparison::addBase(const cv::Mat& test, const cv::Mat& reference, double testLuminance,
                             double referenceLuminance) {
    Band& base = bands_.back();
    const double padding = cv::mean(reference)[0];
    const auto filtered = [&](const cv::Mat& picture, double luminance) {
        const RadialFilter filter(
            picture.size(), 2 * std::sqrt(2.0) * base.frequency,
            [luminance](double frequency) { return neuralSensitivity(frequency, luminance); });
        return filter.apply(picture, padding);
    };
    add(base, filtered(test, testLuminance), filtered(reference, referenceLuminance));
}

cv::Mat BandComparison::sensitivity(std::size_t b) const {
    const SensitivityCurve curve(bands_[b].frequency);
    cv::Mat out = bicubicResize(logLuminance_, bands_[b].difference[0].size()).clone();
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x)
            out.at<double>(y, x) = curve.at(out.at<double>(y, x));
    return out;
}

cv::Mat BandComparison::neighbours(std::size_t b, std::size_t o) const {
    const Band& band = bands_[b];
    const cv::Size size = band.difference[0].size();
    cv::Mat out(size, CV_64F, cv::Scalar(0));
    const auto add = [&](const Band& other, double divisor) {
        const cv::Mat& mask = other.mutualMask[std::min(o, other.mutualMask.size() - 1)];
        out += cv::max(bicubicResize(mask, size), 0) / divisor;
    };
    if (b > 0) add(bands_[b - 1], band.norm / 2);
    if (b + 2 < bands_.size())
        add(bands_[b + 1], 2 * band.norm);  // the base is left out, because it masks no band
    return out;
}

HdrVdpBand BandComparison::compare(std::size_t b, std::size_t o, const cv::Mat& sensitivity,
                                   const cv::Mat& weight) const {
    const Band& band = bands_[b];
    const cv::Mat& self = band.mutualMask[o];
    cv::Mat others(self.size(), CV_64F, cv::Scalar(0));
    for (std::size_t k = 0; k < band.mutualMask.size(); ++k)
        if (k != o) others += band.mutualMask[k];
    const cv::Mat beside = neighbours(b, o);
    std::vector<cv::Vec3d> sums(static_cast<std::size_t>(self.rows));
    cv::parallel_for_({0, self.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            sums[static_cast<std::size_t>(y)] = comparedRow(
                {band.difference[o].ptr<double>(y), self.ptr<double>(y), others.ptr<double>(y),
                 beside.ptr<double>(y), isBase(b) ? nullptr : sensitivity.ptr<double>(y),
                 weight.ptr<double>(y)},
                self.cols, band.norm);
    });
    // Sums the rows in order, so that the result does not depend on the number of threads.
    const cv::Vec3d total = std::accumulate(sums.begin(), sums.end(), cv::Vec3d(0, 0, 0));
    const auto pixels = static_cast<double>(self.total());
    return {static_cast<int>(b) + 1,
            static_cast<int>(o) + 1,
            self.size(),
            band.frequency,
            qualityWeight(band.frequency),
            std::sqrt(total[0]) / pixels,
            total[1],
            band.meanReference[o],
            band.meanTest[o],
            cv::mean(sensitivity)[0],
            cv::mean(self)[0],
            total[2] / pixels};
}

std::vector<HdrVdpBand> BandComparison::compare(const cv::Mat& weight) const {
    std::vector<HdrVdpBand> out;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const cv::Mat csf = sensitivity(b);
        const cv::Mat here = bicubicResize(weight, bands_[b].difference[0].size());
        for (std::size_t o = 0; o < bands_[b].difference.size(); ++o)
            out.push_back(compare(b, o, csf, here));
    }
    return out;
}

}  // namespace mfar::eval::hdrvdp
