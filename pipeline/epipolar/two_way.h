#pragma once

#include "pipeline/epipolar/epipolar_search.h"

#include <memory>
#include <optional>

namespace mfar {

/// The paper's two-way error (eq. 2) where the flow comes from epipolar lines: the still is
/// searched for along the same lines in the frame, and a point of the frame should come back to
/// itself. Costs a second search. What only one of the two pictures shows does not come back.
class TwoWayTest {
public:
    TwoWayTest(const StereoRig& rig, std::shared_ptr<Workers> workers,
               const EpipolarOptions& options);

    /// The search from the still to the frame, at the pose that the forward search settled on.
    void run(const EpipolarSearch& forward, const ImageView& frame);
    /// The same of the frame's luma.
    void run(const EpipolarSearch& forward, const Rows<const std::uint8_t>& frame);

    /// How far from itself a point of the frame comes back [px]; nothing: the still cannot show it.
    /// `ray` of the frame, `s` its inverse depth in the forward search.
    [[nodiscard]] std::optional<float> error(const Eigen::Vector2d& ray, double s) const;

private:
    void searchBack(const EpipolarSearch& forward);

    CameraModel video_, still_;
    EpipolarSearch backward_;
    RigidTransform pose_;
};

}  // namespace mfar
