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

    /// Stores s of every cell of a frame, row-major, see EpipolarLens. s and the translation of
    /// `T_still_frame` are in the search's unit of length. A length of 1 in the search is a length
    /// of `unit` in the tracked poses.
    void keep(std::span<const float> s, const RigidTransform& T_still_frame, double unit);
    /// Must be called when the still is replaced or the depths are no longer valid.
    void forget() { kept_.clear(); }

    /// Returns the predicted s of every cell of a frame with the relative pose `T_still_frame`;
    /// units are those of keep(). Empty if no frame is stored, or if the stored frame does not show
    /// a large enough part of the new frame. Valid until the next call.
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
