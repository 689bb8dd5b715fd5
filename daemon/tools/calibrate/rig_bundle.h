#pragma once

#include "base/geometry.h"
#include "daemon/tools/calibrate/target.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mfar::calibration {

/// What all views share, in this order: video camera (fx fy cx cy k1 k2 p1 p2 k3), still camera
/// (the same), T_still_video (rotation [rad], translation [m], in the still's frame), offset of the
/// still's clock [s].
inline constexpr int kStillAt = 9, kExtrinsicAt = 18, kOffsetAt = 24, kShared = 25;

/// All views of a board's two sensors adjusted together: the cameras, how they stand to each other,
/// the offset of the still's clock and the target's pose in every video frame, from the corners in
/// both sensors' pictures. A still's pose is that of the video between four frames around it, so
/// that the stills know the baseline and the clocks without any frame at the very same time.
/// Levenberg-Marquardt with a robust cost.
class RigBundle {
public:
    RigBundle(const Target& target, const StereoRig& rig, double offset);

    /// A pose T_camera_target that is to be found; returns its index.
    int addPose(const RigidTransform& start);
    /// A view with a pose of its own. The corners must outlive this. Returns the view's index.
    int addView(bool still, const std::vector<Corner>& corners, int pose);
    /// A still between four poses of the video, at `times` [s] after the still, by their clocks.
    int addTied(const std::vector<Corner>& corners, const std::array<int, 4>& poses,
                const std::array<double, 4>& times);

    /// sigma: of a corner's coordinate [px] per sensor, video first. `fixed`: shared parameters
    /// that keep their value. Throws Unsuitable when the views do not determine the others.
    void solve(const std::array<double, 2>& sigma, const std::array<bool, kShared>& fixed);

    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    [[nodiscard]] double offset() const { return offset_; }
    /// Standard deviations of the shared parameters after solve(), 0 where fixed.
    [[nodiscard]] const Eigen::Matrix<double, kShared, 1>& deviations() const {
        return deviations_;
    }
    /// measured - expected [px] per corner of a view.
    [[nodiscard]] std::vector<Eigen::Vector2d> residuals(int view) const;

private:
    struct View {
        bool still = false, tied = false;
        const std::vector<Corner>* corners = nullptr;
        std::array<int, 4> poses{};
        std::array<double, 4> times{};
    };
    struct Linear {
        Eigen::MatrixXd H;
        Eigen::VectorXd g;
    };

    [[nodiscard]] RigidTransform poseOf(const View& view) const;
    [[nodiscard]] const CameraModel& cameraOf(const View& view) const {
        return view.still ? rig_.still : rig_.video;
    }
    [[nodiscard]] int columns() const { return kShared + 6 * static_cast<int>(poses_.size()); }
    [[nodiscard]] double cost(const std::array<double, 2>& sigma) const;
    [[nodiscard]] Eigen::MatrixXd poseJacobian(const View& view) const;
    void linearise(const View& view, double sigma, Linear& out) const;
    [[nodiscard]] Linear linearise(const std::array<double, 2>& sigma,
                                   const std::array<bool, kShared>& fixed) const;
    void apply(const Eigen::VectorXd& step);

    const Target* target_;
    StereoRig rig_;
    double offset_;
    std::vector<RigidTransform> poses_;
    std::vector<View> views_;
    Eigen::Matrix<double, kShared, 1> deviations_ = Eigen::Matrix<double, kShared, 1>::Zero();
};

}  // namespace mfar::calibration
