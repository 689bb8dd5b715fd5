#pragma once

#include "base/geometry.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/flow/luma_image.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <span>

namespace mfar {

/// An earlier frame. Depth is measured by matching a later frame with it.
struct Keyframe {
    LumaImage luma;
    Pose pose;
    double brightness = 0;  ///< mean luma
    long number = 0;        ///< number of the frame; the first frame has number 1
};

/// The last frames that were taken from different camera positions. While the camera rests, no
/// frames are added or removed, because a new frame would not show a new view.
class Keyframes {
public:
    Keyframes(const CameraModel& video, const KeyframeOptions& options);

    void forget();
    /// Keeps a frame if the camera has moved noticeably since the newest keyframe. `inverseDepth`:
    /// inverse depth of a typical point of the scene [1/m]. `brightness`: mean luma.
    void add(const Rows<const std::uint8_t>& luma, const Pose& pose, double brightness,
             double inverseDepth);

    struct Choice {
        const Keyframe* frame;
        double angle;  ///< mean parallax [rad]
    };
    /// Chooses a keyframe for the rectangle `part` [px] of a frame at this pose. Empty if no
    /// keyframe shows this part with enough parallax. With KeyframeRule::Score, the keyframe with
    /// the lowest score is chosen. The score is the expected error of inverse depth, sigma / (f
    /// sin(parallax)), increased for older keyframes and for a different exposure. The result is
    /// valid until the next add().
    [[nodiscard]] std::optional<Choice> choose(const Pose& pose, double brightness,
                                               const PixelRect& part, double inverseDepth) const;

private:
    /// How a keyframe sees the points of a part of the picture, if all of them are at the same
    /// inverse depth.
    struct Relation {
        double angle = 0;    ///< mean parallax [rad]
        double overlap = 0;  ///< share of the points that lie in the keyframe's picture
    };
    [[nodiscard]] Relation relationOf(const RigidTransform& T_key_now,
                                      std::span<const Eigen::Vector2d> rays,
                                      double inverseDepth) const;

    CameraModel video_;
    KeyframeOptions options_;
    std::deque<Keyframe> frames_;  // newest first
    long count_ = 0;
};

/// Returns the mean of the pixels.
[[nodiscard]] double brightnessOf(const Rows<const std::uint8_t>& luma);

}  // namespace mfar
