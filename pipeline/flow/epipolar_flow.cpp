#include "pipeline/flow/epipolar_flow.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kCell = 4;
constexpr float kNowhere = 1e4F;
// Neighbours on one slanted surface that land on the same cell differ by this much [px].
constexpr float kSlope = 1.0F;

Size cellsOf(Size video) {
    return {(video.width + kCell - 1) / kCell, (video.height + kCell - 1) / kCell};
}

}  // namespace

EpipolarFlow::EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers)
    : rig_(rig), cells_(cellsOf(rig.video.size)), search_(rig.video, std::move(workers)),
      lens_(rig.video, 0) {
    const std::size_t count = static_cast<std::size_t>(cells_.width) * cells_.height;
    forward_.resize(count);
    hidden_.resize(count);
    nearness_.resize(count);
    nearest_.resize(count);
}

void EpipolarFlow::setStill(const LumaImage& still, const Pose& pose) {
    search_.setStill(still);
    stillPose_ = pose.T_world_video;
}

void EpipolarFlow::run(const ImageView& video, const Pose& pose) {
    lumaOf(video, luma_);
    RigidTransform T_still_video = stillPose_->inverse() * pose.T_world_video;
    // The still at the video's geometry keeps the video's orientation; only its centre is its own.
    T_still_video.translation +=
        rig_.T_still_video.rotation.conjugate() * rig_.T_still_video.translation;
    search_.run(luma_, T_still_video);
    fillForward();
    testDepth();
}

// The middle two of a cell's four central pixels: an edge between them does not pull it off.
void EpipolarFlow::fillForward() {
    const Size video = rig_.video.size;
    const auto& field = search_.inverseDepth();
    const Eigen::Matrix3f& r = search_.rotation();
    const Eigen::Vector3f& t = search_.translation();
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const int x = std::min(kCell * i + 1, video.width - 2);
            const int y = std::min(kCell * j + 1, video.height - 2);
            const std::size_t p = static_cast<std::size_t>(y) * video.width + x;
            std::array<float, 4> s{field[p], field[p + 1], field[p + video.width],
                                   field[p + video.width + 1]};
            std::sort(s.begin(), s.end());
            const float nearness = 0.5F * (s[1] + s[2]);
            const float rx = 0.5F * (lens_.rayX(p) + lens_.rayX(p + video.width + 1));
            const float ry = 0.5F * (lens_.rayY(p) + lens_.rayY(p + video.width + 1));
            const float sx = rx + nearness * (t.x() - rx * t.z());
            const float sy = ry + nearness * (t.y() - ry * t.z());
            const float z = r(2, 0) * sx + r(2, 1) * sy + r(2, 2);
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width + i;
            nearness_[cell] = nearness;
            if (!(z > 0.05F)) {
                forward_[cell] = {kNowhere, kNowhere, 0, 0};
                continue;
            }
            const auto q = lens_.project((r(0, 0) * sx + r(0, 1) * sy + r(0, 2)) / z,
                                         (r(1, 0) * sx + r(1, 1) * sy + r(1, 2)) / z);
            forward_[cell] = {q.x - static_cast<float>(x) - 0.5F,
                              q.y - static_cast<float>(y) - 0.5F, 0, 0};
        }
    }
}

// The still's cell that a cell of the video lands on.
std::optional<std::size_t> EpipolarFlow::landing(int i, int j) const {
    const auto& u = forward_[static_cast<std::size_t>(j) * cells_.width + i];
    const float x = static_cast<float>(i) + u[0] / kCell, y = static_cast<float>(j) + u[1] / kCell;
    if (!(x > -0.5F && y > -0.5F && x < static_cast<float>(cells_.width) - 0.5F &&
          y < static_cast<float>(cells_.height) - 0.5F))
        return std::nullopt;
    return static_cast<std::size_t>(y + 0.5F) * cells_.width + static_cast<std::size_t>(x + 0.5F);
}

void EpipolarFlow::testDepth() {
    std::fill(nearest_.begin(), nearest_.end(), -kNowhere);
    for (int j = 0; j < cells_.height; ++j)
        for (int i = 0; i < cells_.width; ++i)
            if (const auto to = landing(i, j))
                nearest_[*to] = std::max(nearest_[*to],
                                         nearness_[static_cast<std::size_t>(j) * cells_.width + i]);
    const auto pixels = static_cast<float>(search_.pixelsPerUnit());
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width + i;
            const auto to = landing(i, j);
            const float error = to ? (nearest_[*to] - nearness_[cell]) * pixels - kSlope : kNowhere;
            hidden_[cell] = {std::max(error, 0.0F), 0, 0, 0};
        }
    }
}

}  // namespace mfar
