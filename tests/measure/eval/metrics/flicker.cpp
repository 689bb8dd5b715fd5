#include "tests/measure/eval/metrics/flicker.h"

#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr float kUnknown = 1e9F;

double bilinear(const cv::Mat& of, double x, double y) {
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const double fx = x - left, fy = y - top;
    const auto along = [&](int row) {
        const double* values = of.ptr<double>(row) + left;
        return values[0] + fx * (values[1] - values[0]);
    };
    return along(top) + fy * (along(top + 1) - along(top));
}

}  // namespace

double flicker(const cv::Mat& before, const cv::Mat& after, const cv::Mat& flow, int border) {
    CV_Assert(before.size() == after.size() && flow.type() == CV_32FC2);
    const double scaleX = static_cast<double>(before.cols + 2 * border) / flow.cols,
                 scaleY = static_cast<double>(before.rows + 2 * border) / flow.rows;
    double sum = 0;
    std::size_t count = 0;
    for (int y = 0; y < before.rows; ++y) {
        const auto* vectors = flow.ptr<cv::Vec2f>(static_cast<int>((y + border + 0.5) / scaleY));
        for (int x = 0; x < before.cols; ++x) {
            const cv::Vec2f& v = vectors[static_cast<int>((x + border + 0.5) / scaleX)];
            if (!(std::abs(v[0]) < kUnknown && std::abs(v[1]) < kUnknown)) continue;
            const double px = x + scaleX * v[0], py = y + scaleY * v[1];
            if (!(px >= 0 && py >= 0 && px < after.cols - 1 && py < after.rows - 1)) continue;
            const double change = before.at<double>(y, x) - bilinear(after, px, py);
            sum += change * change;
            ++count;
        }
    }
    if (count == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::sqrt(sum / static_cast<double>(count) / 2);
}

}  // namespace mfar::eval
