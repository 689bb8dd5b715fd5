#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

namespace mfar::eval {

enum class DisPreset { Fast, Medium };

struct PaperOptions {
    DisPreset flow = DisPreset::Medium;
    double alpha = 2;  ///< two-way error of the flow at which the confidence is 0 [video px]
};

/// Peer for super-resolution: the paper's method with OpenCV only. DIS flow is computed in both
/// directions between frame and still, and gives the confidence of eq. 2. The flow is enlarged
/// bilinearly and remaps the still at full resolution. The result is blended by confidence with the
/// bicubically enlarged video. Uses OpenCV's threads.
class PaperPipeline {
public:
    PaperPipeline(const StereoRig& rig, Size output, const PaperOptions& options = {});

    /// Sets the still for the following frames: CV_8UC3 of the rig's still size.
    void setStill(const cv::Mat& still);
    /// Returns a CV_8UC3 picture of the output's size, valid until the next run. `video`: CV_8UC3.
    const cv::Mat& run(const cv::Mat& video);

    /// Confidence of the last frame, CV_32F in [0, 1], at the video's size.
    [[nodiscard]] const cv::Mat& confidence() const { return confidence_; }

private:
    StereoRig rig_;
    PaperOptions options_;
    /// Position in the still of each video pixel and of each output pixel.
    cv::Mat videoMap_, outputMap_;
    cv::Ptr<cv::DISOpticalFlow> dis_;
    cv::Mat still_, stillGrey_, grey_, forward_, backward_, confidence_;
    cv::Mat shift_, weight_, warped_, enlarged_;
};

/// Confidence by eq. 2 of the paper, CV_32F in [0, 1]; 0 where the flow leads outside the picture.
/// `forward`: flow from one picture to another, `backward`: flow in the opposite direction, both
/// CV_32FC2 [px].
[[nodiscard]] cv::Mat twoWayConfidence(const cv::Mat& forward, const cv::Mat& backward,
                                       double alpha);

[[nodiscard]] cv::Ptr<cv::DISOpticalFlow> createDis(DisPreset preset);

}  // namespace mfar::eval
