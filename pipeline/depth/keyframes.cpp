#include "pipeline/depth/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace mfar {
namespace {

// Between two successive keyframes, the rotation of the camera plus the parallax of a typical point
// of the scene is at least this angle [rad].
constexpr double kLeastStep = 0.002;
// The score of a keyframe is the expected error, so lower is better. It is doubled at age kAge
// [frames], and multiplied by 1 + kExposure if the mean lumas of keyframe and frame differ by a
// factor of e, which shows a different exposure.
constexpr double kAge = 60;
constexpr double kExposure = 2;
constexpr int kGrid = 4;  // number of sample points along each axis of a part of the picture

}  // namespace

double brightnessOf(const Rows<const std::uint8_t>& luma) {
    const auto [width, height] = luma.size;
    std::uint64_t sum = 0;
    for (int y = 0; y < height; ++y)
        sum += std::accumulate(luma[y], luma[y] + width, std::uint32_t{0});
    return width > 0 && height > 0 ? static_cast<double>(sum) / (1.0 * width * height) : 0;
}

Keyframes::Keyframes(const CameraModel& video, const KeyframeOptions& options)
    : video_(video), options_(validated(options)) {}

void Keyframes::forget() {
    frames_.clear();
}

void Keyframes::add(const Rows<const std::uint8_t>& luma, const Pose& pose, double brightness,
                    double inverseDepth) {
    ++count_;
    if (!frames_.empty()) {
        const RigidTransform T = frames_.front().pose.T_world_video.inverse() * pose.T_world_video;
        const double turn = 2 * T.rotation.vec().norm();
        if (turn + inverseDepth * T.translation.norm() < kLeastStep) return;
    }
    Keyframe frame;
    if (frames_.size() >= static_cast<std::size_t>(options_.frames)) {
        frame = std::move(frames_.back());
        frames_.pop_back();
    }
    cut(luma, {0, 0, luma.size.width, luma.size.height}, frame.luma);
    frame.pose = pose;
    frame.brightness = brightness;
    frame.number = count_;
    frames_.push_front(std::move(frame));
}

Keyframes::Relation Keyframes::relationOf(const RigidTransform& T_key_now,
                                          std::span<const Eigen::Vector2d> rays,
                                          double inverseDepth) const {
    Relation out;
    const double share = 1.0 / static_cast<double>(rays.size());
    for (const Eigen::Vector2d& ray : rays) {
        const Eigen::Vector3d turned = T_key_now.rotation * ray.homogeneous();
        const Eigen::Vector3d p = turned + inverseDepth * T_key_now.translation;
        out.angle += share * std::atan2(turned.cross(p).norm(), turned.dot(p));
        if (!(p.z() > 0)) continue;
        const Eigen::Vector2d q = video_.project(p.hnormalized());
        if (q.minCoeff() >= 0 && q.x() < video_.size.width && q.y() < video_.size.height)
            out.overlap += share;
    }
    return out;
}

std::optional<Keyframes::Choice> Keyframes::choose(const Pose& pose, double brightness,
                                                   const PixelRect& part,
                                                   double inverseDepth) const {
    std::array<Eigen::Vector2d, static_cast<std::size_t>(kGrid) * kGrid> rays;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::size_t column = i % kGrid, row = i / kGrid;
        const auto middle = [](std::size_t cell) {
            return (static_cast<double>(cell) + 0.5) / kGrid;
        };
        rays[i] = video_.unproject({std::lerp(part.x0, part.x1, middle(column)) - 0.5,
                                    std::lerp(part.y0, part.y1, middle(row)) - 0.5});
    }
    std::optional<Choice> best;
    double least = 0;
    for (const Keyframe& frame : frames_) {
        const long age = count_ + 1 - frame.number;
        if (options_.rule == KeyframeRule::Fixed && age < options_.distance) continue;
        const RigidTransform T_key_now = frame.pose.T_world_video.inverse() * pose.T_world_video;
        const auto [angle, overlap] = relationOf(T_key_now, rays, inverseDepth);
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
