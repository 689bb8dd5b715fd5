#pragma once

#include "base/geometry.h"
#include "daemon/tools/calibrate/target.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mfar::calibration {

/// Positions in the vector of parameters that all views share; kShared is its length. The vector
/// has, in this order: video camera (fx fy cx cy k1 k2 p1 p2 k3), still camera (the same nine),
/// T_still_video (rotation [rad] and translation [m] in the still camera's frame), offset of the
/// still camera's clock [s].
inline constexpr int kStillAt = 9, kExtrinsicAt = 18, kOffsetAt = 24, kShared = 25;

/// Adjusts all parameters together, so that they fit the corners in all views of both sensors. The
/// parameters are both cameras, the extrinsics, the offset of the still camera's clock, and the
/// poses of addPose(). The method is Levenberg-Marquardt with a robust cost.
///
/// The pose of a still that addTied() adds is interpolated between the poses of the four video
/// frames around the still. So these stills determine the baseline and the clock offset, although
/// no video frame was taken at exactly the same time.
class RigBundle {
public:
    RigBundle(const Target& target, const StereoRig& rig, double offset);

    /// Adds an unknown pose T_camera_target with its initial value. Returns the index of the pose.
    int addPose(const RigidTransform& start);
    /// Adds a view that has the pose with index `pose`. The corners must outlive this object.
    /// Returns the index of the view.
    int addView(bool still, const std::vector<Corner>& corners, int pose);
    /// Adds a still whose pose is interpolated between four poses of the video. `times`: for each
    /// of these poses, its time on the video's clock, minus the still's time on the still camera's
    /// clock [s]. Returns the index of the view.
    int addTied(const std::vector<Corner>& corners, const std::array<int, 4>& poses,
                const std::array<double, 4>& times);

    /// Solves for all parameters. `sigma`: standard deviation of a corner's coordinate [px], first
    /// in the video, then in stills. `fixed`: true for each shared parameter that keeps its value.
    /// Throws Unsuitable if the views do not determine the parameters that are not fixed.
    void solve(const std::array<double, 2>& sigma, const std::array<bool, kShared>& fixed);

    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    [[nodiscard]] double offset() const { return offset_; }
    /// Returns the standard deviations of the shared parameters after solve(), 0 for fixed ones.
    [[nodiscard]] const Eigen::Matrix<double, kShared, 1>& deviations() const {
        return deviations_;
    }
    /// Returns the residual of each corner of a view: measured minus expected position [px].
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
