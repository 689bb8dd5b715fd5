#include "tests/measure/eval/metrics/bicubic_resize.h"

#include <cmath>
#include <vector>

namespace mfar::eval {
namespace {

struct ResizeTap {
    std::vector<int> index;
    std::vector<double> weight;
};

double keysCubic(double x) {
    x = std::abs(x);
    if (x <= 1) return (1.5 * x - 2.5) * x * x + 1;
    return x <= 2 ? ((-0.5 * x + 2.5) * x - 4) * x + 2 : 0;
}

int reflectedIndex(int i, int n) {
    i %= 2 * n;
    if (i < 0) i += 2 * n;
    return i < n ? i : 2 * n - 1 - i;
}

std::vector<ResizeTap> resizeTaps(int from, int to) {
    const double scale = static_cast<double>(to) / from, stretch = std::min(scale, 1.0);
    const double width = 4 / stretch;
    const int count = static_cast<int>(std::ceil(width)) + 2;
    std::vector<ResizeTap> out(static_cast<std::size_t>(to));
    for (int j = 0; j < to; ++j) {
        const double at = (j + 0.5) / scale - 0.5;
        const int first = static_cast<int>(std::floor(at - width / 2));
        ResizeTap& tap = out[static_cast<std::size_t>(j)];
        double sum = 0;
        for (int i = first; i < first + count; ++i) {
            const double weight = keysCubic(stretch * (at - i));
            if (weight == 0) continue;
            tap.index.push_back(reflectedIndex(i, from));
            tap.weight.push_back(weight);
            sum += weight;
        }
        for (double& weight : tap.weight)
            weight /= sum;
    }
    return out;
}

cv::Mat resizedRows(const cv::Mat& picture, int rows) {
    const auto taps = resizeTaps(picture.rows, rows);
    cv::Mat out(rows, picture.cols, CV_64F, cv::Scalar(0));
    cv::parallel_for_({0, rows}, [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; ++y) {
            const ResizeTap& tap = taps[static_cast<std::size_t>(y)];
            auto* to = out.ptr<double>(y);
            for (std::size_t k = 0; k < tap.index.size(); ++k) {
                const auto* from = picture.ptr<double>(tap.index[k]);
                for (int x = 0; x < out.cols; ++x)
                    to[x] += tap.weight[k] * from[x];
            }
        }
    });
    return out;
}

cv::Mat resizedColumns(const cv::Mat& picture, int cols) {
    const auto taps = resizeTaps(picture.cols, cols);
    cv::Mat out(picture.rows, cols, CV_64F);
    cv::parallel_for_({0, out.rows}, [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; ++y)
            for (int x = 0; x < cols; ++x) {
                const ResizeTap& tap = taps[static_cast<std::size_t>(x)];
                double sum = 0;
                for (std::size_t k = 0; k < tap.index.size(); ++k)
                    sum += tap.weight[k] * picture.at<double>(y, tap.index[k]);
                out.at<double>(y, x) = sum;
            }
    });
    return out;
}

}  // namespace

cv::Mat bicubicResize(const cv::Mat& picture, cv::Size size) {
    CV_Assert(picture.type() == CV_64F && !picture.empty() && size.width > 0 && size.height > 0);
    const cv::Mat tall = size.height == picture.rows ? picture : resizedRows(picture, size.height);
    return size.width == tall.cols ? tall : resizedColumns(tall, size.width);
}

}  // namespace mfar::eval
