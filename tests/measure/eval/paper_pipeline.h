#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

namespace mfar::eval {

enum class DisPreset { Fast, Medium };

struct PaperOptions {
    DisPreset flow = DisPreset::Medium;
    double alpha = 2;  ///< two-way error at which the confidence reaches zero [video px]
};

/// Peer for super-resolution: the paper's method, using OpenCV only. DIS flow in both directions
/// between video frame and still, confidence by the paper's eq. 2, flow up-scaled bilinearly, still
/// remapped at full resolution and blended with the bicubically up-scaled video by confidence. Uses
/// OpenCV's threads.
class PaperPipeline {
public:
    PaperPipeline(const StereoRig& rig, Size output, const PaperOptions& options = {});

    /// The still for the following frames: CV_8UC3 of the rig's still size. Per-still work.
    void setStill(const cv::Mat& still);
    /// The picture, CV_8UC3 of the output size, valid until the next run. Frame: CV_8UC3.
    const cv::Mat& run(const cv::Mat& video);

    /// Eq. 2 confidence of the last frame, CV_32F in [0, 1] at video size.
    [[nodiscard]] const cv::Mat& confidence() const { return confidence_; }

private:
    StereoRig rig_;
    PaperOptions options_;
    cv::Mat videoMap_, outputMap_;  ///< the still pixel of every video pixel, and of every output
                                    ///< pixel
    cv::Ptr<cv::DISOpticalFlow> dis_;
    cv::Mat still_, stillGrey_, grey_, forward_, backward_, confidence_;
    cv::Mat shift_, weight_, warped_, upscaled_;
};

/// Eq. 2; look-ups outside the picture have confidence 0. Flows CV_32FC2 [px]: `forward` from a to
/// b, `backward` from b to a. Result CV_32F in [0, 1].
[[nodiscard]] cv::Mat twoWayConfidence(const cv::Mat& forward, const cv::Mat& backward,
                                       double alpha);

/// A DIS instance with OpenCV's preset.
[[nodiscard]] cv::Ptr<cv::DISOpticalFlow> createDis(DisPreset preset);

}  // namespace mfar::eval
