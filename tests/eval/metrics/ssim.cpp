#include "tests/eval/metrics/ssim.h"

#include <opencv2/imgproc.hpp>

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

}  // namespace

double ssim(const cv::Mat& picture, const cv::Mat& truth) {
    CV_Assert(picture.type() == CV_64F && truth.type() == CV_64F && picture.size() == truth.size());
    CV_Assert(truth.cols >= kWindow && truth.rows >= kWindow);
    const cv::Mat meanX = windowMean(picture), meanY = windowMean(truth);
    const cv::Mat meanXX = windowMean(picture.mul(picture));
    const cv::Mat meanYY = windowMean(truth.mul(truth));
    const cv::Mat meanXY = windowMean(picture.mul(truth));
    double sum = 0;
    for (int y = 0; y < meanX.rows; ++y)
        for (int x = 0; x < meanX.cols; ++x) {
            const double mx = meanX.at<double>(y, x), my = meanY.at<double>(y, x);
            const double vx = meanXX.at<double>(y, x) - mx * mx;
            const double vy = meanYY.at<double>(y, x) - my * my;
            const double cov = meanXY.at<double>(y, x) - mx * my;
            sum += (2 * mx * my + kC1) * (2 * cov + kC2) /
                   ((mx * mx + my * my + kC1) * (vx + vy + kC2));
        }
    return sum / static_cast<double>(meanX.total());
}

}  // namespace mfar::eval
