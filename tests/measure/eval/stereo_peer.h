#pragma once

#include "base/geometry.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace mfar::eval {

/// Peer for flow with known poses: OpenCV's StereoSGBM (3-way) or StereoBM on rectified pictures.
/// The number of disparities is a sixth of the width, rounded up to a multiple of 16. Pixels that
/// OpenCV finds occluded or ambiguous get the smaller one of the disparities on both sides of the
/// gap in the row, which belongs to the farther surface.
class StereoPeer {
public:
    enum class Matcher { SemiGlobal, Block };
    explicit StereoPeer(const StereoRig& rig, Matcher matcher = Matcher::SemiGlobal);

    /// Sets the still for the following frames: CV_8UC3 of the rig's still size.
    void setStill(const cv::Mat& still);

    struct Result {
        cv::Mat flow;  ///< CV_32FC2 [video px], see FlowField in pipeline/results.h; NaN: no result
        double ms = 0;  ///< time of rectifying both pictures and matching, without making the maps
    };
    /// The whole flow is NaN if the views cannot be rectified. `video`: CV_8UC3. `T_still_frame`
    /// maps video camera coordinates at the frame's time to still camera coordinates at the still's
    /// time.
    [[nodiscard]] Result run(const cv::Mat& video, const RigidTransform& T_still_frame);

private:
    StereoRig rig_;
    int disparities_;
    cv::Ptr<cv::StereoMatcher> matcher_;
    cv::Mat still_;
};

}  // namespace mfar::eval
