#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

inline constexpr int kTileSide = 64;            ///< side of a tile [px]
inline constexpr double kTileTolerance = 0.25;  ///< default of `tolerance` [grey levels]

/// Share of the tiles whose root mean square error exceeds that of plain bicubic enlargement by
/// more than `tolerance` grey levels. There a method did visible harm. Incomplete tiles at the
/// right and bottom edges are skipped; NaN if no tile is complete. All pictures CV_64F in grey
/// levels, same size.
[[nodiscard]] double tilesBelow(const cv::Mat& picture, const cv::Mat& bicubic,
                                const cv::Mat& truth, double tolerance = kTileTolerance);

}  // namespace mfar::eval
