#pragma once

#include "base/geometry.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace mfar::eval {

/// Peer for flow with a known pose: OpenCV's StereoSGBM, 3-way, or StereoBM on the rectified
/// pictures. Its range of disparities is [0, width / 6). Pixels that it leaves open (occluded in
/// the still by its own check, or ambiguous) are filled along the row with the farther of the two
/// neighbours.
class StereoPeer {
public:
    enum class Matcher { SemiGlobal, Block };
    explicit StereoPeer(const StereoRig& rig, Matcher matcher = Matcher::SemiGlobal);

    /// The still for the following frames: CV_8UC3 of the rig's still size. Per-still work.
    void setStill(const cv::Mat& still);

    struct Result {
        cv::Mat flow;   ///< CV_32FC2 [video px], FlowField in pipeline/results.h; NaN = no answer
        double ms = 0;  ///< rectification of both pictures and matching; the maps are made before
    };
    /// No result in any pixel if rectification is impossible. Frame: CV_8UC3. `T_still_frame`:
    /// video camera coordinates at the frame's time -> still camera coordinates at the still's
    /// time.
    [[nodiscard]] Result run(const cv::Mat& video, const RigidTransform& T_still_frame);

private:
    StereoRig rig_;
    int disparities_;
    cv::Ptr<cv::StereoMatcher> matcher_;
    cv::Mat still_;  ///< grey, at the video's geometry
};

}  // namespace mfar::eval
