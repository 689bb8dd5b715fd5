#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

inline constexpr int kTileSide = 64;
inline constexpr double kTileTolerance = 0.25;

/// Share of the tiles of `picture` that are worse than bicubic enlargement: their RMS error exceeds
/// that of `bicubic` by more than `tolerance` grey levels. Incomplete tiles at the right and bottom
/// are skipped; NaN if no tile is complete. All pictures are CV_64F in grey levels, of the same
/// size.
[[nodiscard]] double tilesBelow(const cv::Mat& picture, const cv::Mat& bicubic,
                                const cv::Mat& truth, double tolerance = kTileTolerance);

}  // namespace mfar::eval
