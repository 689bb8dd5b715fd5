#pragma once

#include "base/geometry.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/flow/luma_image.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <span>

namespace mfar {

/// A frame to measure depth against.
struct Keyframe {
    LumaImage luma;
    Pose pose;
    double brightness = 0;  ///< mean luma
    long number = 0;        ///< of the frames, from the first
};

/// The last frames from different places. A camera that rests keeps those it has: no other frame
/// would add a view.
class Keyframes {
public:
    Keyframes(const CameraModel& video, const KeyframeOptions& options);

    void forget();
    /// Takes a frame, if the camera has moved by more than rounding since the newest. `rho`: of the
    /// scene [1/m], what a typical point of it has. `brightness`: of the luma.
    void add(const Rows<const std::uint8_t>& luma, const Pose& pose, double brightness, double rho);

    struct Choice {
        const Keyframe* frame;
        double angle;  ///< mean parallax [rad]
    };
    /// For these pixels of a frame at this pose; nothing when none shows them with parallax. The
    /// score is the error of inverse depth to be expected, sigma / (f sin(parallax)), raised with
    /// age and difference in exposure (design, section 6). Valid until the next add().
    [[nodiscard]] std::optional<Choice> choose(const Pose& pose, double brightness,
                                               const PixelRect& part, double rho) const;

private:
    /// How a part's points of that inverse depth are seen from there.
    struct Relation {
        double angle = 0;    ///< mean parallax [rad]
        double overlap = 0;  ///< share of them that is in the picture there
    };
    [[nodiscard]] Relation relationOf(const RigidTransform& T_key_now,
                                      std::span<const Eigen::Vector2d> rays, double rho) const;

    CameraModel video_;
    KeyframeOptions options_;
    std::deque<Keyframe> frames_;  // newest first
    long count_ = 0;
};

/// Mean of the pixels.
[[nodiscard]] double brightnessOf(const Rows<const std::uint8_t>& luma);

}  // namespace mfar
