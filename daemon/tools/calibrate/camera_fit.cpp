#include "daemon/tools/calibrate/camera_fit.h"

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mfar::calibration {
namespace {

constexpr int kLeastCorners = 6;
constexpr int kRounds = 4;          // each round fits a camera, then removes bad corners and views
constexpr double kCornerLimit = 6;  // corners with a longer residual are removed [sigma]
constexpr double kLeastSigma = 0.01;  // [px]
// Largest RMS error of a view, as a share of the picture's width. A view with a larger error does
// not show the target.
constexpr double kMaxViewError = 0.03;
// Focal lengths of the first estimate, as multiples of the picture's width. They correspond to
// horizontal fields of view from 106 to 19 degrees.
constexpr std::array kFocalLengths{0.38, 0.54, 0.76, 1.07, 1.5, 2.1, 3.0};

struct Points {
    std::vector<cv::Point3f> target;
    std::vector<cv::Point2f> picture;
};

Points pointsOf(const Target& target, const TargetView& view) {
    const auto f = [](double v) { return static_cast<float>(v); };
    Points out;
    for (const Corner& c : view.corners) {
        const Eigen::Vector3d& p = target.points[c.index];
        out.target.emplace_back(f(p.x()), f(p.y()), f(p.z()));
        out.picture.emplace_back(f(c.pixel.x()), f(c.pixel.y()));
    }
    return out;
}

cv::Matx33d matrixOf(const CameraModel& c) {
    return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
}

RigidTransform transformOf(const cv::Vec3d& rotation, const cv::Vec3d& translation) {
    const Eigen::Vector3d r(rotation[0], rotation[1], rotation[2]);
    const double angle = r.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(r / angle) : Eigen::Vector3d::UnitX();
    return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)),
            {translation[0], translation[1], translation[2]}};
}

/// Six numbers by which views are compared. They describe the target in the view: its position in
/// the picture (two numbers), distance, tilt (two numbers) and rotation.
using Features = Eigen::Matrix<double, 6, 1>;

Features featuresOf(const TargetView& view, const RigidTransform& T, Size picture) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Corner& c : view.corners)
        middle += c.pixel / static_cast<double>(view.corners.size());
    const Eigen::Matrix3d R = T.rotation.toRotationMatrix();
    Features out;
    out << middle / picture.width, std::log(T.translation.norm()), R.col(2).head<2>() * 1.5,
        std::atan2(R(1, 0), R(0, 0)) * 0.3;
    return out;
}

/// Chooses views that differ as much as possible. Starts with the view that has the most corners.
/// Repeatedly adds the view that differs most from all chosen ones.
std::vector<int> mostDifferent(const std::vector<TargetView>& views,
                               const std::vector<std::optional<RigidTransform>>& poses,
                               Size picture, int most) {
    std::vector<int> usable;
    std::vector<Features> features(views.size());
    for (int i = 0; i < static_cast<int>(views.size()); ++i) {
        if (!poses[i]) continue;
        usable.push_back(i);
        features[i] = featuresOf(views[i], *poses[i], picture);
    }
    std::vector<double> distance(views.size(), std::numeric_limits<double>::infinity());
    std::vector<int> out;
    const auto corners = [&](int i) { return views[i].corners.size(); };
    while (static_cast<int>(out.size()) < std::min<int>(most, static_cast<int>(usable.size()))) {
        const int next = *std::ranges::max_element(usable, [&](int a, int b) {
            return distance[a] != distance[b] ? distance[a] < distance[b] : corners(a) < corners(b);
        });
        out.push_back(next);
        for (const int i : usable)
            distance[i] = std::min(distance[i], (features[i] - features[next]).norm());
        distance[next] = -1;
    }
    std::ranges::sort(out);
    return out;
}

CameraModel calibrated(const Target& target, const std::vector<TargetView>& views,
                       const std::vector<int>& chosen, const CameraModel& guess) {
    std::vector<std::vector<cv::Point3f>> on;
    std::vector<std::vector<cv::Point2f>> seen;
    for (const int i : chosen) {
        Points p = pointsOf(target, views[i]);
        on.push_back(std::move(p.target));
        seen.push_back(std::move(p.picture));
    }
    cv::Mat K(matrixOf(guess)), D = cv::Mat::zeros(5, 1, CV_64F), turns, places;
    // QR instead of SVD takes a quarter of the time off. The damping of Levenberg and Marquardt
    // keeps the equations well conditioned.
    cv::calibrateCamera(on, seen, {guess.size.width, guess.size.height}, K, D, turns, places,
                        cv::CALIB_FIX_K3 | cv::CALIB_USE_INTRINSIC_GUESS | cv::CALIB_USE_QR);
    CameraModel out = guess;
    out.fx = K.at<double>(0, 0);
    out.fy = K.at<double>(1, 1);
    out.cx = K.at<double>(0, 2);
    out.cy = K.at<double>(1, 2);
    for (int i = 0; i < 5; ++i)
        out.distortion[i] = D.at<double>(i);
    return out;
}

double median(std::vector<double> v) {
    if (v.empty()) return 0;
    const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

/// Returns the robust standard deviation [px] of the residuals' coordinates, over all views that
/// have a pose.
double spreadOf(const Target& target, const std::vector<TargetView>& views, const CameraFit& fit) {
    std::vector<double> components;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!fit.poses[i]) continue;
        for (const Eigen::Vector2d& r : residualsOf(target, views[i], fit.camera, *fit.poses[i])) {
            components.push_back(std::abs(r.x()));
            components.push_back(std::abs(r.y()));
        }
    }
    return std::max(kLeastSigma, 1.4826 * median(std::move(components)));
}

/// Removes corners with large residuals, because they are not corners of the target. Returns true
/// if any corner was removed.
bool dropCorners(const Target& target, TargetView& view, const CameraFit& fit,
                 const RigidTransform& pose) {
    const auto residuals = residualsOf(target, view, fit.camera, pose);
    std::vector<Corner> kept;
    for (std::size_t k = 0; k < residuals.size(); ++k)
        if (residuals[k].norm() <= kCornerLimit * fit.sigma) kept.push_back(view.corners[k]);
    if (kept.size() == view.corners.size()) return false;
    view.corners = std::move(kept);
    return true;
}

/// Computes the target's pose in each view with the fitted camera. Removes corners and views that
/// do not fit. `outside`: true for each removed view; such a view is never used again. Returns true
/// if a corner or view was removed, or if a view now has a pose and had none before.
bool placeViews(const Target& target, std::vector<TargetView>& views, CameraFit& fit,
                std::vector<bool>& outside) {
    bool changed = false;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (outside[i]) continue;
        const bool wasPlaced = fit.poses[i].has_value();
        fit.poses[i] = targetPose(target, views[i], fit.camera);
        changed = changed || fit.poses[i].has_value() != wasPlaced;
    }
    fit.sigma = spreadOf(target, views, fit);
    std::vector<double> errors;
    std::vector<std::size_t> placed;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!fit.poses[i]) continue;
        if (dropCorners(target, views[i], fit, *fit.poses[i])) {
            changed = true;
            fit.poses[i] = targetPose(target, views[i], fit.camera);
            if (!fit.poses[i]) continue;
        }
        placed.push_back(i);
        errors.push_back(rms(residualsOf(target, views[i], fit.camera, *fit.poses[i])));
    }
    const std::vector<bool> bad = outliers(errors);
    for (std::size_t k = 0; k < placed.size(); ++k) {
        if (!bad[k]) continue;
        fit.poses[placed[k]].reset();
        outside[placed[k]] = true;
        changed = true;
    }
    return changed;
}

}  // namespace

std::optional<RigidTransform> targetPose(const Target& target, const TargetView& view,
                                         const CameraModel& camera) {
    if (static_cast<int>(view.corners.size()) < kLeastCorners) return std::nullopt;
    const Points points = pointsOf(target, view);
    cv::Vec3d rotation, translation;
    try {
        if (!cv::solvePnP(points.target, points.picture, matrixOf(camera), camera.distortion,
                          rotation, translation))
            return std::nullopt;
    } catch (const cv::Exception&) {
        return std::nullopt;
    }
    RigidTransform T = transformOf(rotation, translation);
    const double error = rms(residualsOf(target, view, camera, T));
    if (!(T.translation.z() > 0) || !(error < kMaxViewError * camera.size.width))
        return std::nullopt;
    return T;
}

std::vector<Eigen::Vector2d> residualsOf(const Target& target, const TargetView& view,
                                         const CameraModel& camera,
                                         const RigidTransform& T_camera_target) {
    std::vector<Eigen::Vector2d> out;
    for (const Corner& c : view.corners) {
        const Eigen::Vector3d p = T_camera_target * target.points[c.index];
        out.push_back(c.pixel - camera.project(p.head<2>() / p.z()));
    }
    return out;
}

double rms(const std::vector<Eigen::Vector2d>& residuals) {
    double sum = 0;
    for (const Eigen::Vector2d& r : residuals)
        sum += r.squaredNorm();
    return residuals.empty() ? 0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

CameraModel guessedCamera(const Target& target, const std::vector<TargetView>& views,
                          Size picture) {
    CameraModel camera, best;
    camera.size = picture;
    camera.cx = 0.5 * (picture.width - 1);
    camera.cy = 0.5 * (picture.height - 1);
    double least = std::numeric_limits<double>::infinity();
    for (const double focal : kFocalLengths) {
        camera.fx = camera.fy = focal * picture.width;
        double sum = 0;
        for (const TargetView& view : views) {
            const auto pose = targetPose(target, view, camera);
            sum += pose ? rms(residualsOf(target, view, camera, *pose))
                        : kMaxViewError * picture.width;
        }
        if (!(sum < least)) continue;
        least = sum;
        best = camera;
    }
    return best;
}

std::vector<bool> outliers(const std::vector<double>& values) {
    std::vector<bool> out(values.size());
    if (values.empty()) return out;
    const double centre = median(values);
    std::vector<double> away;
    for (const double v : values)
        away.push_back(std::abs(v - centre));
    const double limit = std::max(2 * centre, centre + 4 * 1.4826 * median(away));
    std::transform(values.begin(), values.end(), out.begin(),
                   [&](double v) { return !(v <= limit); });
    return out;
}

CameraFit fitCamera(const Target& target, std::vector<TargetView>& views, const CameraModel& guess,
                    const std::string& sensor, int most) {
    CameraFit fit;
    for (const TargetView& view : views)
        fit.poses.push_back(targetPose(target, view, guess));
    std::vector<bool> outside(views.size());
    for (int round = 0; round < kRounds; ++round) {
        fit.chosen = mostDifferent(views, fit.poses, guess.size, most);
        try {
            fit.camera = calibrated(target, views, fit.chosen, guess);
        } catch (const cv::Exception& e) {
            throw Unsuitable(fmt::format("the views of the {} sensor do not determine its lens; "
                                         "take pictures of the target from more directions ({})",
                                         sensor, e.err));
        }
        if (!(fit.camera.fx > 0 && fit.camera.fy > 0))
            throw Unsuitable(fmt::format("the views of the {} sensor do not determine its lens; "
                                         "take pictures of the target from more directions",
                                         sensor));
        if (!placeViews(target, views, fit, outside)) break;
    }
    std::erase_if(fit.chosen, [&](int i) { return !fit.poses[i]; });
    return fit;
}

}  // namespace mfar::calibration
