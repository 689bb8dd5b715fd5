#include "pipeline/depth/keyframes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mfar {
namespace {

// A frame is taken when a typical point has moved by this much against the newest [rad].
constexpr double kLeastStep = 0.002;
// A score this many frames old counts twice, one whose exposure differs by a factor of e three
// times.
constexpr double kAge = 60;
constexpr double kExposure = 2;
constexpr int kGrid = 4;  // points a side, spread over a part

}  // namespace

double brightnessOf(const LumaImage& luma) {
    const auto sum = static_cast<double>(
        std::accumulate(luma.pixels.begin(), luma.pixels.end(), std::uint64_t{0}));
    return luma.pixels.empty() ? 0 : sum / static_cast<double>(luma.pixels.size());
}

Keyframes::Keyframes(const CameraModel& video, const KeyframeOptions& options)
    : video_(video), options_(validated(options)) {}

void Keyframes::forget() {
    frames_.clear();
}

void Keyframes::add(const LumaImage& luma, const Pose& pose, double brightness, double rho) {
    ++count_;
    if (!frames_.empty()) {
        const RigidTransform T = frames_.front().pose.T_world_video.inverse() * pose.T_world_video;
        const double turn = 2 * T.rotation.vec().norm();
        if (turn + rho * T.translation.norm() < kLeastStep) return;
    }
    Keyframe frame;
    if (frames_.size() >= static_cast<std::size_t>(options_.frames)) {
        frame = std::move(frames_.back());  // its memory
        frames_.pop_back();
    }
    frame.luma = luma;
    frame.pose = pose;
    frame.brightness = brightness;
    frame.number = count_;
    frames_.push_front(std::move(frame));
}

Keyframes::Relation Keyframes::relationOf(const RigidTransform& T_key_now, const PixelRect& part,
                                          double rho) const {
    Relation out;
    for (int j = 0; j < kGrid; ++j) {
        for (int i = 0; i < kGrid; ++i) {
            const Eigen::Vector2d ray =
                video_.unproject({std::lerp(part.x0, part.x1, (i + 0.5) / kGrid) - 0.5,
                                  std::lerp(part.y0, part.y1, (j + 0.5) / kGrid) - 0.5});
            const Eigen::Vector3d turned = T_key_now.rotation * ray.homogeneous();
            const Eigen::Vector3d p = turned + rho * T_key_now.translation;
            out.angle += std::atan2(turned.cross(p).norm(), turned.dot(p)) / (kGrid * kGrid);
            if (!(p.z() > 0)) continue;
            const Eigen::Vector2d q = video_.project(p.hnormalized());
            if (q.minCoeff() >= 0 && q.x() < video_.size.width && q.y() < video_.size.height)
                out.overlap += 1.0 / (kGrid * kGrid);
        }
    }
    return out;
}

std::optional<Keyframes::Choice> Keyframes::choose(const Pose& pose, double brightness,
                                                   const PixelRect& part, double rho) const {
    std::optional<Choice> best;
    double least = 0;
    for (const Keyframe& frame : frames_) {
        const long age = count_ + 1 - frame.number;
        if (options_.rule == KeyframeRule::Fixed && age < options_.distance) continue;
        const RigidTransform T_key_now = frame.pose.T_world_video.inverse() * pose.T_world_video;
        const auto [angle, overlap] = relationOf(T_key_now, part, rho);
        if (!(angle >= options_.leastAngle && overlap >= options_.leastOverlap)) continue;
        if (options_.rule == KeyframeRule::Angle && angle < options_.angle) continue;
        const double exposure = std::abs(std::log((brightness + 1) / (frame.brightness + 1)));
        const double score = (1 + static_cast<double>(age) / kAge) * (1 + kExposure * exposure) /
                             std::sin(std::min(angle, 1.0));
        if (best && score >= least) continue;
        least = score;
        best = Choice{&frame, angle};
        if (options_.rule != KeyframeRule::Score) break;
    }
    return best;
}

}  // namespace mfar
