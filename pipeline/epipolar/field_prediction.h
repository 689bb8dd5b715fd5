#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_lens.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Predicts the inverse depths of the next frame: carries those of one frame over by the poses,
/// onto cells of 4x4 pixels. Where several surfaces meet, the nearest one is kept (z-test).
class FieldPrediction {
public:
    explicit FieldPrediction(const CameraModel& video);

    /// `nearness`: s of every cell, row-major, see EpipolarLens [1/unit]; `T_still_frame`: its
    /// translation in units; `unit`: in the poses' unit of length.
    void keep(std::span<const float> nearness, const RigidTransform& T_still_frame, double unit);
    /// Discards the kept frame: the still is new or the depths are no longer valid.
    void forget() { kept_.clear(); }

    /// s of every cell of a frame with that pose [1/unit]. Empty when no frame is kept or the kept
    /// frame does not show the same part of the scene. Valid until the next call.
    [[nodiscard]] std::span<const float> in(const RigidTransform& T_still_frame, double unit);

private:
    void land(const RigidTransform& T_still_frame, double unit);
    [[nodiscard]] bool fillGaps();

    EpipolarLens cells_;
    std::vector<float> kept_, landed_, filled_;
    std::vector<std::int32_t> landing_;  // cell where each cell of kept_ lands
    std::vector<float> moved_;           // s at the landing place
    RigidTransform keptPose_;
    double unit_ = 1;
};

}  // namespace mfar
