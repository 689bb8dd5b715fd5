#include "tests/measure/eval/metrics/psnr.h"

#include <cmath>

namespace mfar::eval {

double meanSquaredError(const cv::Mat& picture, const cv::Mat& truth) {
    CV_Assert(picture.type() == CV_64F && truth.type() == CV_64F && picture.size() == truth.size());
    return cv::norm(picture, truth, cv::NORM_L2SQR) / static_cast<double>(truth.total());
}

double psnr(const cv::Mat& picture, const cv::Mat& truth) {
    return 10 * std::log10(255.0 * 255.0 / meanSquaredError(picture, truth));
}

}  // namespace mfar::eval
