#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_lens.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Predicts the inverse depths of the next frame. The points of the stored frame are moved to the
/// next frame's pose. If several points move to one cell, the nearest is kept (z-test).
class FieldPrediction {
public:
    explicit FieldPrediction(const CameraModel& video);

    /// Stores s of every cell of a frame, row-major, see EpipolarLens. s and the translation of
    /// `T_still_frame` use the search's unit of length. `unit` is the size of this unit [unit of
    /// length of the tracked poses], see UnitPose::unit.
    void keep(std::span<const float> s, const RigidTransform& T_still_frame, double unit);
    /// Must be called when a new still arrives, or when the stored depths are no longer valid.
    void forget() { kept_.clear(); }

    /// Returns the predicted s of every cell of a frame with the relative pose `T_still_frame`. For
    /// the units, see keep(). The result is empty if no frame is stored, or if the stored frame
    /// shows too little of the new frame. It is valid until the next call.
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
