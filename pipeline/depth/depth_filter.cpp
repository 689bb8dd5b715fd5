#include "pipeline/depth/depth_filter.h"

#include "base/se3.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr float kNearestShare = 0.05F;  // [of the depth before]
// Of inverse depth, in a second of motion without a measurement.
constexpr double kDrift = 0.02;
// The camera rested before that [s].
constexpr double kMostMoving = 0.2;
// Motions of the picture below this are added up: each time it is carried, points are rounded to
// pixels [px].
constexpr float kLeastMotion = 0.25F;
// Measurements of one still share its errors: the filter cannot know better than this part of one.
constexpr float kLeastShare = 0.09F;
constexpr float kGate = 9;  // of squared deviations
constexpr std::uint8_t kMostOutliers = 2;

}  // namespace

DepthFilter::DepthFilter(const CameraModel& video, std::shared_ptr<Workers> workers)
    : lens_(video, 0), focal_(static_cast<float>(std::max(video.fx, video.fy))),
      pixelX_(static_cast<float>(1 / video.fx)), pixelY_(static_cast<float>(1 / video.fy)),
      workers_(std::move(workers)), field_(video.size), carried_(video.size),
      points_(field_.rho.size()), carriedPoints_(field_.rho.size()) {}

void DepthFilter::forget() {
    if (!fieldPose_) return;
    field_ = InverseDepthField(field_.size);
    std::fill(points_.begin(), points_.end(), Point());
    known_ = {};
    fieldPose_.reset();
}

void DepthFilter::predict(const RigidTransform& told, double seconds) {
    const std::optional<RigidTransform> T_world_video = soundMotion(told);
    if (!T_world_video) forget();
    if (!T_world_video || !fieldPose_) {
        fieldPose_ = T_world_video;
        return;
    }
    const RigidTransform T_now_before = T_world_video->inverse() * *fieldPose_;
    if (seconds > 0) moving_ = std::min(moving_ + seconds, kMostMoving);
    if (!moves(T_now_before)) return;
    const auto growth = static_cast<float>(kDrift * kDrift * std::exchange(moving_, 0));
    for (int y = known_.y0; y < known_.y1; ++y) {
        const auto row = static_cast<std::size_t>(y) * field_.size.width;
        for (std::size_t i = row + known_.x0; i < row + known_.x1; ++i)
            field_.variance[i] += growth * field_.rho[i] * field_.rho[i];
    }
    carry(T_now_before);
    fieldPose_ = *T_world_video;
}

bool DepthFilter::moves(const RigidTransform& T) const {
    const float turn = static_cast<float>(2 * T.rotation.vec().norm());
    float nearest = 0;
    for (int y = known_.y0; y < known_.y1; ++y) {
        const float* row = field_.rho.data() + static_cast<std::size_t>(y) * field_.size.width;
        nearest = std::max(nearest, *std::max_element(row + known_.x0, row + known_.x1));
    }
    return focal_ * (turn + nearest * static_cast<float>(T.translation.norm())) > kLeastMotion;
}

void DepthFilter::carry(const RigidTransform& T_now_before) {
    const Eigen::Matrix3f R = T_now_before.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f t = T_now_before.translation.cast<float>();
    carriedTo_ = {};
    for (int y = known_.y0; y < known_.y1; ++y)
        carryRow(R, t, y);
    std::swap(field_, carried_);
    std::swap(points_, carriedPoints_);
    const PixelRect before = std::exchange(known_, carriedTo_);
    for (int y = before.y0; y < before.y1; ++y)
        carried_.forgetRow(y, before.x0, before.x1);
    closeCracks();
}

// Points are homogeneous, (x, y, 1, rho): what is infinitely far only turns.
void DepthFilter::carryRow(const Eigen::Matrix3f& R, const Eigen::Vector3f& t, int y) {
    const int width = field_.size.width;
    const auto first = static_cast<std::size_t>(y) * width;
    for (std::size_t i = first + known_.x0; i < first + known_.x1; ++i) {
        if (!field_.isKnown(i)) continue;
        const float rho = field_.rho[i];
        const Point& point = points_[i];
        const Eigen::Vector3f turned = R * Eigen::Vector3f(lens_.rayX(i) + pixelX_ * point.x,
                                                           lens_.rayY(i) + pixelY_ * point.y, 1);
        const Eigen::Vector3f p = turned + rho * t;
        if (!(p.z() > kNearestShare)) continue;
        const auto q = lens_.project(p.x() / p.z(), p.y() / p.z());
        const int landed = lens_.pixelAt(q);
        if (landed < 0) continue;
        const auto to = static_cast<std::size_t>(landed);
        const float moved = rho / p.z();
        if (carried_.isKnown(to) && carried_.rho[to] >= moved) continue;
        const float slope = turned.z() / (p.z() * p.z());  // of moved by rho
        const float variance = field_.variance[i] * slope * slope;
        if (!InverseDepthField::isSound(moved, variance)) continue;
        carried_.rho[to] = moved;
        carried_.variance[to] = variance;
        carried_.filled[to] = field_.filled[i];
        const int column = landed % width, row = landed / width;
        carriedTo_ = around(carriedTo_, {column, row, column + 1, row + 1});
        carriedPoints_[to] = {q.x - static_cast<float>(column), q.y - static_cast<float>(row),
                              point.outliers};
    }
}

// A surface that comes nearer spreads its points; between them it goes on.
void DepthFilter::closeCracks() {
    const int width = field_.size.width;
    for (int y = known_.y0; y < known_.y1; ++y)
        for (int x = known_.x0 + 1; x + 1 < known_.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * width + x;
            closeCrack(i, i - 1, i + 1);
        }
    for (int y = known_.y0 + 1; y + 1 < known_.y1; ++y)
        for (int x = known_.x0; x < known_.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * width + x;
            closeCrack(i, i - width, i + width);
        }
}

void DepthFilter::closeCrack(std::size_t i, std::size_t before, std::size_t after) {
    if (field_.isKnown(i) || !field_.isKnown(before) || !field_.isKnown(after)) return;
    const float apart = field_.rho[after] - field_.rho[before];
    const float sum = field_.variance[before] + field_.variance[after];
    if (apart * apart > kGate * sum) return;
    field_.rho[i] = 0.5F * field_.rho[before] + 0.5F * field_.rho[after];
    field_.variance[i] = 0.5F * sum + apart * apart;
    field_.filled[i] = 1;
    points_[i] = {};
}

void DepthFilter::fuse(const InverseDepthField& measured, const PixelRect& where) {
    known_ = around(known_, where);
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const auto row = static_cast<std::size_t>(y) * field_.size.width;
            for (std::size_t i = row + where.x0; i < row + where.x1; ++i)
                if (InverseDepthField::isSound(measured.rho[i], measured.variance[i]))
                    fusePixel(i, measured.rho[i], measured.variance[i]);
        }
    });
}

void DepthFilter::fusePixel(std::size_t i, float rho, float variance) {
    const bool known = field_.isKnown(i);
    const float sum = field_.variance[i] + variance, apart = rho - field_.rho[i];
    if (known && apart * apart <= kGate * sum) {
        const float gain = field_.variance[i] / sum;
        field_.rho[i] += gain * apart;
        field_.variance[i] = std::max((1 - gain) * field_.variance[i], kLeastShare * variance);
        field_.filled[i] = 0;
        points_[i] = {(1 - gain) * points_[i].x, (1 - gain) * points_[i].y, 0};
        return;
    }
    if (known && ++points_[i].outliers < kMostOutliers) return;
    field_.rho[i] = rho;
    field_.variance[i] = variance;
    field_.filled[i] = 0;
    points_[i] = {};
}

void DepthFilter::forget(const PixelRect& where) {
    for (int y = where.y0; y < where.y1; ++y)
        field_.forgetRow(y, where.x0, where.x1);
}

}  // namespace mfar
