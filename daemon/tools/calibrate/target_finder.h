#pragma once

#include "base/image_view.h"
#include "daemon/tools/calibrate/target.h"
#include "pipeline/track/tag_detector.h"

#include <opencv2/core.hpp>

#include <array>
#include <vector>

namespace mfar::calibration {

/// Finds the corners of a target in pictures of one size. All corners of both kinds of target are
/// places where black and white squares meet crosswise. Such corners have a symmetry of 180
/// degrees, so neither blur nor gamma moves them.
class TargetFinder {
public:
    /// The target must outlive this.
    TargetFinder(const Target& target, Size picture);

    /// Corners, precise to about 0.05 px; empty when the target is not found. `luma`: Gray8.
    [[nodiscard]] std::vector<Corner> find(const ImageView& luma);

private:
    [[nodiscard]] std::vector<Corner> findTags(const ImageView& luma);
    [[nodiscard]] std::vector<Corner> findBoard(const ImageView& luma) const;
    [[nodiscard]] std::vector<TagDetection> detect(const cv::Mat& picture);
    [[nodiscard]] int leastTags() const;  ///< needed in one picture to determine their orientation
    void learnTurn(const std::vector<TagDetection>& tags);

    const Target& target_;
    std::array<TagDetector, 2> detectors_;  ///< for borders of one and of two cells
    int border_ = -1;  ///< index of the detector that finds this target, -1: unknown
    cv::Mat thinned_;
    int turn_ = -1;  ///< quarter turns of the printed tags against the grid, -1: unknown
};

}  // namespace mfar::calibration
