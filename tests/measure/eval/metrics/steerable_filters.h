#pragma once

#include <opencv2/core.hpp>

#include <array>

namespace mfar::eval {

/// Filters of a steerable pyramid with four orientations (Simoncelli and Freeman 1995, "sp3" of
/// matlabPyrTools), applied by correlation. CV_64F, rows downwards.
struct SteerableFilters {
    cv::Mat highPass;                    ///< 15x15, applied to the whole picture; sums to 0
    cv::Mat firstLowPass;                ///< 9x9, applied before the first pyramid level; sums to 1
    cv::Mat lowPass;                     ///< 17x17, applied before each halving; sums to 2
    std::array<cv::Mat, 4> orientation;  ///< 9x9 each, sum to 0
};

[[nodiscard]] SteerableFilters steerableFilters();

/// Correlates at every `step`-th sample of both axes, starting with the first. An axis of n samples
/// gives ceil(n / step) results. The border is mirrored without repeating the edge. `picture`:
/// CV_64F; `taps`: odd size; `step`: 1 or 2.
[[nodiscard]] cv::Mat correlate(const cv::Mat& picture, const cv::Mat& taps, int step = 1);

}  // namespace mfar::eval
