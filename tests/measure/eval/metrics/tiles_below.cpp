#include "tests/measure/eval/metrics/tiles_below.h"

#include "tests/measure/eval/metrics/psnr.h"

#include <cmath>
#include <limits>

namespace mfar::eval {

double tilesBelow(const cv::Mat& picture, const cv::Mat& bicubic, const cv::Mat& truth,
                  double tolerance) {
    CV_Assert(picture.size() == truth.size() && bicubic.size() == truth.size());
    int tiles = 0, below = 0;
    for (int y = 0; y + kTileSide <= truth.rows; y += kTileSide)
        for (int x = 0; x + kTileSide <= truth.cols; x += kTileSide) {
            const cv::Rect tile(x, y, kTileSide, kTileSide);
            const double ours = std::sqrt(meanSquaredError(picture(tile), truth(tile)));
            const double theirs = std::sqrt(meanSquaredError(bicubic(tile), truth(tile)));
            ++tiles;
            if (ours > theirs + tolerance) ++below;
        }
    if (tiles == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(below) / tiles;
}

}  // namespace mfar::eval
