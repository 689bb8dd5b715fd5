#include "tests/measure/eval/metrics/ssim.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::eval {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
constexpr double kC2 = (0.03 * 255) * (0.03 * 255);

cv::Mat windowMean(const cv::Mat& values) {
    cv::Mat mean;
    cv::GaussianBlur(values, mean, {kWindow, kWindow}, kSigma);
    const int margin = kWindow / 2;
    return mean(cv::Rect(margin, margin, values.cols - kWindow + 1, values.rows - kWindow + 1));
}

struct SsimMeans {
    double similarity = 0;
    double structure = 0;  // contrast and structure, without luminance
};

SsimMeans ssimMeans(const cv::Mat& picture, const cv::Mat& truth) {
    CV_Assert(picture.type() == CV_64F && truth.type() == CV_64F && picture.size() == truth.size());
    CV_Assert(truth.cols >= kWindow && truth.rows >= kWindow);
    const cv::Mat meanX = windowMean(picture), meanY = windowMean(truth);
    const cv::Mat meanXX = windowMean(picture.mul(picture));
    const cv::Mat meanYY = windowMean(truth.mul(truth));
    const cv::Mat meanXY = windowMean(picture.mul(truth));
    SsimMeans sum;
    for (int y = 0; y < meanX.rows; ++y)
        for (int x = 0; x < meanX.cols; ++x) {
            const double mx = meanX.at<double>(y, x), my = meanY.at<double>(y, x);
            const double vx = meanXX.at<double>(y, x) - mx * mx;
            const double vy = meanYY.at<double>(y, x) - my * my;
            const double cov = meanXY.at<double>(y, x) - mx * my;
            const double structure = (2 * cov + kC2) / (vx + vy + kC2);
            sum.structure += structure;
            sum.similarity += (2 * mx * my + kC1) / (mx * mx + my * my + kC1) * structure;
        }
    const auto windows = static_cast<double>(meanX.total());
    return {sum.similarity / windows, sum.structure / windows};
}

cv::Mat halved(const cv::Mat& values) {
    const cv::Rect even(0, 0, values.cols / 2 * 2, values.rows / 2 * 2);
    cv::Mat out;
    cv::resize(values(even), out, {even.width / 2, even.height / 2}, 0, 0, cv::INTER_AREA);
    return out;
}

}  // namespace

double ssim(const cv::Mat& picture, const cv::Mat& truth) {
    return ssimMeans(picture, truth).similarity;
}

double msSsim(const cv::Mat& picture, const cv::Mat& truth) {
    CV_Assert(std::min(truth.cols, truth.rows) >= kMsSsimSmallestSide);
    constexpr std::array<double, 5> kWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
    cv::Mat a = picture, b = truth;
    double out = 1;
    for (std::size_t scale = 0; scale < kWeights.size(); ++scale) {
        const SsimMeans means = ssimMeans(a, b);
        const bool coarsest = scale + 1 == kWeights.size();
        const double factor = coarsest ? means.similarity : means.structure;
        out *= std::pow(std::max(factor, 0.0), kWeights[scale]);
        if (coarsest) break;
        a = halved(a);
        b = halved(b);
    }
    return out;
}

}  // namespace mfar::eval
