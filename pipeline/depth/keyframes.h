#pragma once

#include "base/geometry.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/flow/luma_image.h"

#include <cstddef>
#include <deque>
#include <optional>
#include <span>

namespace mfar {

struct Keyframe {
    LumaImage luma;
    Pose pose;
    double brightness = 0;
    long number = 0;
};

/// The last frames with different camera poses. While the camera rests, the stored frames stay the
/// same.
class Keyframes {
public:
    Keyframes(const CameraModel& video, const KeyframeOptions& options);

    void forget();
    /// Stores a frame if the camera has moved noticeably since the newest keyframe. `inverseDepth`
    /// is the inverse depth of a typical point of the scene [1/m]. `brightness` is the mean luma,
    /// [0, 255].
    void add(const Rows<const std::uint8_t>& luma, const Pose& pose, double brightness,
             double inverseDepth);

    struct Choice {
        const Keyframe* frame;
        double angle;  ///< mean parallax [rad]
    };
    /// Chooses a keyframe for the rectangle `part` [px] of a frame at this pose. `inverseDepth` is
    /// the inverse depth of a typical point of this part [1/m]. The result is empty if no keyframe
    /// shows the part with enough parallax. With KeyframeRule::Score, the keyframe with the lowest
    /// score is chosen. The score is proportional to the expected error of inverse depth,
    /// 1 / sin(parallax), and is increased for old keyframes and for a different brightness. The
    /// result is valid until the next add() or forget().
    [[nodiscard]] std::optional<Choice> choose(const Pose& pose, double brightness,
                                               const PixelRect& part, double inverseDepth) const;

private:
    /// Relation of a keyframe to a part of the picture whose points all have the same inverse
    /// depth: mean parallax [rad], and share of the points inside the keyframe's picture.
    struct Relation {
        double angle = 0;
        double overlap = 0;
    };
    [[nodiscard]] Relation relationOf(const RigidTransform& T_key_now,
                                      std::span<const Eigen::Vector2d> rays,
                                      double inverseDepth) const;

    CameraModel video_;
    KeyframeOptions options_;
    std::deque<Keyframe> frames_;  // the newest frame is first
    long count_ = 0;
};

/// Returns the mean luma, [0, 255]; 0 for an empty picture.
[[nodiscard]] double brightnessOf(const Rows<const std::uint8_t>& luma);

}  // namespace mfar
