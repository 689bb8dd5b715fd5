#pragma once

#include "base/image_view.h"
#include "daemon/tools/calibrate/target.h"
#include "pipeline/track/tag_detector.h"

#include <opencv2/core.hpp>

#include <array>
#include <vector>

namespace mfar::calibration {

/// Finds the corners of a target in pictures of one size. A corner is a point where two black and
/// two white squares meet, also in an AprilGrid. The picture around such a point is symmetric under
/// a rotation by 180 degrees, so blur and gamma do not move the corner.
class TargetFinder {
public:
    /// `target` must outlive this object.
    TargetFinder(const Target& target, Size picture);

    /// Returns the corners in a Gray8 picture, with an error of about 0.05 px. Returns nothing if
    /// the target is not found.
    [[nodiscard]] std::vector<Corner> find(const ImageView& luma);

private:
    [[nodiscard]] std::vector<Corner> findTags(const ImageView& luma);
    [[nodiscard]] std::vector<Corner> findBoard(const ImageView& luma) const;
    [[nodiscard]] std::vector<TagDetection> detect(const cv::Mat& picture);
    /// Returns how many tags a picture must show to determine the orientation in which they were
    /// printed.
    [[nodiscard]] int leastTags() const;
    void learnTurn(const std::vector<TagDetection>& tags);

    const Target& target_;
    std::array<TagDetector, 2> detectors_;  ///< for tags with borders of one and of two cells
    int border_ = -1;  ///< index of the detector for this target's tags; -1: unknown
    cv::Mat thinned_;
    int turn_ = -1;  ///< orientation of the printed tags in quarter turns; -1: unknown
};

}  // namespace mfar::calibration
