#include "pipeline/track/pose_estimator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

Pose poseOf(const CameraPose& solved, const Matrix6& ambiguous,
            const RigidTransform& T_camera_video, Timestamp time) {
    Pose out;
    out.time = time;
    out.T_world_video = solved.T_world_camera * T_camera_video;
    out.covariance = moved(solved.covariance + ambiguous, T_camera_video.inverse());
    out.tags = solved.tags;
    out.reprojectionError = solved.rms();
    return out;
}

/// Returns the covariance that the pose has because the other solution may be the true one. The
/// error of each solution determines the probability that it is the true one. If the choice is
/// wrong, the pose is wrong by the difference between the two solutions.
Matrix6 ambiguity(const CameraPoses& poses, const CameraPose& chosen, double sigma) {
    if (!poses.other) return Matrix6::Zero();
    const bool isBest = &chosen == &poses.best;
    const CameraPose& other = isBest ? *poses.other : poses.best;
    const double worse = std::max(0., other.squaredError - chosen.squaredError);
    const double share = 0.5 * std::exp(-worse / (2 * sigma * sigma));
    const Vector6 way = logarithm(chosen.T_world_camera.inverse() * other.T_world_camera);
    return share * (1 - share) * way * way.transpose();
}

double distanceTo(std::span<const TagObservation> tags, const std::vector<bool>& used,
                  const RigidTransform& T_world_camera) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (!used[i]) continue;
        sum += (tags[i].T_world_tag.translation - T_world_camera.translation).norm();
        ++count;
    }
    return sum / std::max(count, 1);
}

}  // namespace

PlanarChoice::PlanarChoice(const PlanarChoiceOptions& o) : options_(o) {
    if (!(o.errorSigma > 0 && std::isfinite(o.errorSigma)) || !(o.threshold > 0) ||
        !(o.memory >= 0 && o.memory < 1))
        throw std::invalid_argument(
            "choice between the two planar poses: errorSigma and threshold must be above 0, and "
            "memory must be at least 0 and below 1");
}

const CameraPose& PlanarChoice::choose(const CameraPoses& poses,
                                       const std::optional<RigidTransform>& predicted) {
    flipped_ = false;
    if (!predicted || !poses.other) {
        evidence_ = 0;
        return poses.best;
    }
    const auto turnFrom = [&](const CameraPose& pose) {
        return pose.T_world_camera.rotation.angularDistance(predicted->rotation);
    };
    const bool bestStands = turnFrom(poses.best) <= turnFrom(*poses.other);
    const CameraPose& standing = bestStands ? poses.best : *poses.other;
    const CameraPose& rival = bestStands ? *poses.other : poses.best;
    const double better = (standing.squaredError - rival.squaredError) /
                          (2 * options_.errorSigma * options_.errorSigma);
    evidence_ = std::max(0., options_.memory * evidence_ + better);
    if (!(evidence_ > options_.threshold)) return standing;
    evidence_ = 0;
    flipped_ = true;
    return rival;
}

PoseEstimator::PoseEstimator(const PoseEstimatorOptions& options)
    : options_(options), choice_(options.choice), filter_(options.filter) {}

std::optional<Pose> PoseEstimator::update(std::span<const TagObservation> tags,
                                          const CameraModel& camera, Timestamp time) {
    raw_.reset();
    const auto poses = solveTagPose(tags, camera, options_.tagPose);
    std::optional<Pose> predicted = filter_.predict(time);
    if (!poses) {
        filter_.missed();
        return filter_.predict(time);
    }
    const auto expected =
        predicted ? std::optional(predicted->T_world_video) : std::optional<RigidTransform>();
    const CameraPose& chosen = choice_.choose(*poses, expected);
    raw_ = poseOf(chosen, ambiguity(*poses, chosen, options_.choice.errorSigma), {}, time);
    if (choice_.flipped()) {
        ++flips_;
        filter_.reset();
    }
    const double distance = distanceTo(tags, poses->used, chosen.T_world_camera);
    const PoseFilter::Outcome outcome = filter_.update(*raw_, distance);
    rejected_ += outcome == PoseFilter::Outcome::Rejected ? 1 : 0;
    jumps_ += outcome == PoseFilter::Outcome::Jumped ? 1 : 0;
    std::optional<Pose> out = filter_.predict(time);
    if (out && outcome != PoseFilter::Outcome::Rejected) {
        out->tags = raw_->tags;
        out->reprojectionError = raw_->reprojectionError;
    }
    return out;
}

std::optional<Pose> PoseEstimator::measure(std::span<const TagObservation> tags,
                                           const CameraModel& camera,
                                           const RigidTransform& T_camera_video,
                                           Timestamp time) const {
    const auto poses = solveTagPose(tags, camera, options_.tagPose);
    if (!poses) return std::nullopt;
    std::optional<RigidTransform> expected;
    if (const auto predicted = filter_.predict(time))
        expected = predicted->T_world_video * T_camera_video.inverse();
    PlanarChoice choice(options_.choice);
    const CameraPose& chosen = choice.choose(*poses, expected);
    return poseOf(chosen, ambiguity(*poses, chosen, options_.choice.errorSigma), T_camera_video,
                  time);
}

}  // namespace mfar
