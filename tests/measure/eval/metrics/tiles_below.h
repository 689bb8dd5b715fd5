#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

inline constexpr int kTileSide = 64;            ///< [px]
inline constexpr double kTileTolerance = 0.25;  ///< [grey levels]

/// Share of the tiles whose root mean square error exceeds that of plain bicubic up-scaling by more
/// than `tolerance`: there a method did visible harm. Incomplete tiles at the right and at the
/// bottom are skipped; NaN if there is no complete one. All CV_64F in grey levels, same size.
[[nodiscard]] double tilesBelow(const cv::Mat& picture, const cv::Mat& bicubic,
                                const cv::Mat& truth, double tolerance = kTileTolerance);

}  // namespace mfar::eval
