#include "tests/measure/eval/metrics/radial_filter.h"

#include <algorithm>
#include <cmath>
#include <fftw3.h>

namespace mfar::eval {
namespace {

fftw_complex* spectrumOf(cv::Mat& complex) {
    return reinterpret_cast<fftw_complex*>(complex.ptr<double>());
}

}  // namespace

RadialFilter::RadialFilter(cv::Size size, double pixelsPerDegree,
                           const std::function<double(double)>& gain)
    : size_(size), gain_(size.height + 1, size.width + 1, CV_64F) {
    const double fy = pixelsPerDegree / (2.0 * size.height);
    const double fx = pixelsPerDegree / (2.0 * size.width);
    const double scale = 1 / (4.0 * size.area());
    cv::parallel_for_({0, gain_.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < gain_.cols; ++x)
                gain_.at<double>(y, x) = scale * gain(std::hypot(y * fy, x * fx));
    });
    cv::Mat buffer(2 * size.height, size.width + 1, CV_64FC2);
    forward_.reset(fftw_plan_dft_r2c_2d(2 * size.height, 2 * size.width, buffer.ptr<double>(),
                                        spectrumOf(buffer), FFTW_ESTIMATE));
    backward_.reset(fftw_plan_dft_c2r_2d(2 * size.height, 2 * size.width, spectrumOf(buffer),
                                         buffer.ptr<double>(), FFTW_ESTIMATE));
}

cv::Mat RadialFilter::apply(const cv::Mat& picture, double padding) const {
    CV_Assert(picture.type() == CV_64F && picture.size() == size_);
    cv::Mat buffer(2 * size_.height, size_.width + 1, CV_64FC2, cv::Scalar(padding, padding));
    const cv::Mat values(buffer.rows, 2 * buffer.cols, CV_64F, buffer.data, buffer.step);
    cv::Mat inside = values(cv::Rect({0, 0}, size_));
    picture.copyTo(inside);
    fftw_execute_dft_r2c(forward_.get(), buffer.ptr<double>(), spectrumOf(buffer));
    for (int y = 0; y < buffer.rows; ++y) {
        auto* bin = buffer.ptr<cv::Vec2d>(y);
        const auto* gain = gain_.ptr<double>(std::min(y, buffer.rows - y));
        for (int x = 0; x < buffer.cols; ++x)
            bin[x] *= gain[x];
    }
    fftw_execute_dft_c2r(backward_.get(), spectrumOf(buffer), buffer.ptr<double>());
    return inside.clone();
}

}  // namespace mfar::eval
