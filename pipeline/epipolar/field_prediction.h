#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_lens.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Predicts the inverse depths of the next frame: moves the points of the stored frame according to
/// the poses. If several points move to one cell, the nearest one is kept (z-test).
class FieldPrediction {
public:
    explicit FieldPrediction(const CameraModel& video);

    /// Stores s of every cell of a frame [1/unit], row-major, see EpipolarLens. The translation of
    /// `T_still_frame` is in the same units. `unit` is the length of one unit in the unit of length
    /// of the tracked poses.
    void keep(std::span<const float> s, const RigidTransform& T_still_frame, double unit);
    /// Must be called when the still is replaced or the depths are no longer valid.
    void forget() { kept_.clear(); }

    /// Returns the predicted s [1/unit] of every cell of a frame with the relative pose
    /// `T_still_frame`. Empty if no frame is stored, or if the stored frame does not show a large
    /// enough part of the new frame. Valid until the next call.
    [[nodiscard]] std::span<const float> in(const RigidTransform& T_still_frame, double unit);

private:
    void land(const RigidTransform& T_still_frame, double unit);
    [[nodiscard]] bool fillGaps();

    EpipolarLens cells_;
    std::vector<float> kept_, landed_, filled_;
    std::vector<std::int32_t> landing_;
    std::vector<float> moved_;
    RigidTransform keptPose_;
    double unit_ = 1;
};

}  // namespace mfar
