#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_lens.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Where the surfaces of one frame are in the next: its inverse depths carried over by the poses
/// onto cells of 4x4 pixels, the nearest one where several meet (z-test).
class FieldPrediction {
public:
    explicit FieldPrediction(const CameraModel& video);

    /// `nearness`: s of every cell, row-major, see EpipolarLens [1/unit]; `T_still_frame`: its
    /// translation in units; `unit` in the poses' unit of length.
    void keep(std::span<const float> nearness, const RigidTransform& T_still_frame, double unit);
    /// Of a new still, or when nothing is known any more.
    void forget() { kept_.clear(); }

    /// s of every cell of a frame with that pose [1/unit]; empty when nothing was kept or the kept
    /// frame did not show what this one does. Valid until the next call.
    [[nodiscard]] std::span<const float> in(const RigidTransform& T_still_frame, double unit);

private:
    void land(const RigidTransform& T_still_frame, double unit);
    [[nodiscard]] bool fillGaps();

    EpipolarLens cells_;
    std::vector<float> kept_, landed_, filled_;
    std::vector<std::int32_t> landing_;  // of kept_'s cells
    std::vector<float> moved_;           // s there
    RigidTransform keptPose_;
    double unit_ = 1;
};

}  // namespace mfar
