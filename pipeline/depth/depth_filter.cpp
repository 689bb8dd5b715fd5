#include "pipeline/depth/depth_filter.h"

#include "base/se3.h"
#include "pipeline/simd/depth_rows.h"
#include "pipeline/simd/field_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// If a camera motion reduces the depth of a point to at most this fraction of its old depth, the
// point is dropped.
constexpr float kNearestShare = 0.05F;
// Each second of camera motion adds kDrift^2 to the relative variance of inverse depth.
constexpr double kDrift = 0.02;
// The variance grows with the time since the points were last moved. This time counts as at most
// kMostMoving [s]: if it is longer, the camera has rested in between.
constexpr double kMostMoving = 0.2;
// Points are moved only when the picture has moved by more than this distance [px], because each
// move rounds their positions to pixels.
constexpr float kLeastMotion = 0.25F;
// Smallest variance that fusing can reach, as a fraction of the variance of one measurement.
// Averaging cannot make the variance smaller, because measurements with the same still share
// errors.
constexpr float kLeastShare = 0.09F;
// Two inverse depths agree if their squared difference is at most this multiple of the sum of their
// variances.
constexpr float kGate = 9;
// The known depth of a pixel is replaced after this number of consecutive measurements that
// disagree with it.
constexpr std::uint8_t kMostOutliers = 2;
// Width and height of the blocks of forgetContradicted() [px].
constexpr int kBlock = 16;

}  // namespace

DepthFilter::DepthFilter(const CameraModel& video, EpipolarLens lens,
                         std::shared_ptr<Workers> workers)
    : lens_(std::move(lens)), focal_(static_cast<float>(std::max(video.fx, video.fy))),
      pixelX_(static_cast<float>(1 / video.fx)), pixelY_(static_cast<float>(1 / video.fy)),
      workers_(std::move(workers)), field_(video.size), carried_(video.size),
      points_(field_.inverseDepth.size()), carriedPoints_(field_.inverseDepth.size()) {
    for (auto* plane : {&moved_.x, &moved_.y, &moved_.inverseDepth, &moved_.variance})
        plane->resize(field_.inverseDepth.size());
    moved_.pixel.resize(field_.inverseDepth.size());
    moved_.bounds.resize(video.size.height);
}

void DepthFilter::forget() {
    if (!fieldPose_) return;
    field_ = InverseDepthField(field_.size);
    points_ = Points(field_.inverseDepth.size());
    known_ = {};
    fieldPose_.reset();
    moving_ = 0;
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
    carry(T_now_before, static_cast<float>(kDrift * kDrift * std::exchange(moving_, 0)));
    fieldPose_ = *T_world_video;
}

bool DepthFilter::moves(const RigidTransform& T) const {
    const float turn = static_cast<float>(2 * T.rotation.vec().norm());
    float nearest = 0;
    for (int y = known_.y0; y < known_.y1; ++y) {
        const float* row =
            field_.inverseDepth.data() + static_cast<std::size_t>(y) * field_.size.width;
        nearest = std::max(nearest, simd::greatestOf(row + known_.x0, known_.x1 - known_.x0));
    }
    return focal_ * (turn + nearest * static_cast<float>(T.translation.norm())) > kLeastMotion;
}

// Moves the points to the new pose of the camera. Points are homogeneous, (x, y, 1, inverseDepth),
// so points at infinity (inverse depth 0) are rotated but not translated.
void DepthFilter::carry(const RigidTransform& T_now_before, float growth) {
    const Eigen::Matrix3d R = T_now_before.rotation.toRotationMatrix();
    simd::Motion motion{};
    for (int i = 0; i < 9; ++i)
        motion.turn[i] = static_cast<float>(R(i / 3, i % 3));
    for (int i = 0; i < 3; ++i)
        motion.move[i] = static_cast<float>(T_now_before.translation[i]);
    const simd::MoveRule rule{pixelX_, pixelY_, kNearestShare, growth};
    const auto width = static_cast<std::size_t>(known_.x1 - known_.x0);
    std::fill(moved_.bounds.begin(), moved_.bounds.end(), PixelRect{});
    workers_->forRange(known_.y1 - known_.y0, 8, [&](int first, int last) {
        for (int y = known_.y0 + first; y < known_.y0 + last; ++y) {
            const std::size_t i = static_cast<std::size_t>(y) * field_.size.width + known_.x0;
            simd::moveRow(lens_.lens(), field_.size, motion, rule,
                          {lens_.raysX().data() + i, lens_.raysY().data() + i, points_.x.data() + i,
                           points_.y.data() + i, field_.inverseDepth.data() + i,
                           field_.variance.data() + i},
                          width,
                          {moved_.pixel.data() + i, moved_.x.data() + i, moved_.y.data() + i,
                           moved_.inverseDepth.data() + i, moved_.variance.data() + i},
                          moved_.bounds[y]);
        }
    });
    workers_->forRange(field_.size.height, 8,
                       [&](int first, int last) { takeLanded(first, last); });
    std::swap(field_, carried_);
    std::swap(points_, carriedPoints_);
    const PixelRect before = known_;
    known_ = {};
    for (const PixelRect& row : moved_.bounds)
        known_ = around(known_, row);
    workers_->forRange(before.y1 - before.y0, 32, [&](int first, int last) {
        for (int y = before.y0 + first; y < before.y0 + last; ++y)
            carried_.forgetRow(y, before.x0, before.x1);
    });
    closeCracks();
}

void DepthFilter::takeLanded(int firstRow, int lastRow) {
    const int first = firstRow * field_.size.width, last = lastRow * field_.size.width;
    for (int y = known_.y0; y < known_.y1; ++y) {
        const PixelRect& bounds = moved_.bounds[y];
        if (bounds.empty() || bounds.y1 <= firstRow || bounds.y0 >= lastRow) continue;
        const auto row = static_cast<std::size_t>(y) * field_.size.width;
        for (std::size_t i = row + known_.x0; i < row + known_.x1; ++i) {
            if (moved_.pixel[i] < first || moved_.pixel[i] >= last) continue;
            const auto to = static_cast<std::size_t>(moved_.pixel[i]);
            if (carried_.isKnown(to) && carried_.inverseDepth[to] >= moved_.inverseDepth[i])
                continue;
            carried_.inverseDepth[to] = moved_.inverseDepth[i];
            carried_.variance[to] = moved_.variance[i];
            carried_.filled[to] = field_.filled[i];
            carriedPoints_.x[to] = moved_.x[i];
            carriedPoints_.y[to] = moved_.y[i];
            carriedPoints_.outliers[to] = points_.outliers[i];
        }
    }
}

// Fills gaps of one pixel between points of one surface. Such gaps open when the surface comes
// nearer and its points move apart.
void DepthFilter::closeCracks() {
    const int width = field_.size.width;
    const int columns = known_.x1 - known_.x0 - 2, rows = known_.y1 - known_.y0;
    workers_->forRange(columns > 0 ? rows : 0, 16, [&](int first, int last) {
        for (int y = known_.y0 + first; y < known_.y0 + last; ++y)
            for (int x = known_.x0 + 1; x + 1 < known_.x1; ++x) {
                const auto i = static_cast<std::size_t>(y) * width + x;
                closeCrack(i, i - 1, i + 1);
            }
    });
    workers_->forRange(known_.x1 - known_.x0, 64, [&](int first, int last) {
        for (int y = known_.y0 + 1; y + 1 < known_.y1; ++y)
            for (int x = known_.x0 + first; x < known_.x0 + last; ++x) {
                const auto i = static_cast<std::size_t>(y) * width + x;
                closeCrack(i, i - width, i + width);
            }
    });
}

void DepthFilter::closeCrack(std::size_t i, std::size_t before, std::size_t after) {
    if (field_.isKnown(i) || !field_.isKnown(before) || !field_.isKnown(after)) return;
    const float apart = field_.inverseDepth[after] - field_.inverseDepth[before];
    const float sum = field_.variance[before] + field_.variance[after];
    if (apart * apart > kGate * sum) return;
    field_.inverseDepth[i] = 0.5F * field_.inverseDepth[before] + 0.5F * field_.inverseDepth[after];
    field_.variance[i] = 0.5F * sum + apart * apart;
    field_.filled[i] = 1;
    points_.reset(i);
}

void DepthFilter::fuse(const InverseDepthField& measured, const PixelRect& where,
                       std::span<const std::uint8_t> fixed) {
    known_ = around(known_, where);
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const auto row = static_cast<std::size_t>(y) * field_.size.width;
            for (std::size_t i = row + where.x0; i < row + where.x1; ++i)
                if ((fixed.empty() || fixed[i] == 0) &&
                    InverseDepthField::isSound(measured.inverseDepth[i], measured.variance[i]))
                    fusePixel(i, measured.inverseDepth[i], measured.variance[i]);
        }
    });
}

bool DepthFilter::agrees(std::size_t i, float inverseDepth, float variance) const {
    const float apart = inverseDepth - field_.inverseDepth[i];
    return apart * apart <= kGate * (field_.variance[i] + variance);
}

void DepthFilter::fusePixel(std::size_t i, float inverseDepth, float variance) {
    const bool known = field_.isKnown(i);
    const float sum = field_.variance[i] + variance, apart = inverseDepth - field_.inverseDepth[i];
    if (known && agrees(i, inverseDepth, variance)) {
        const float gain = field_.variance[i] / sum;
        field_.inverseDepth[i] += gain * apart;
        const float least = std::min(kLeastShare * variance, field_.variance[i]);
        field_.variance[i] = std::max((1 - gain) * field_.variance[i], least);
        field_.filled[i] = 0;
        points_.x[i] *= 1 - gain;
        points_.y[i] *= 1 - gain;
        points_.outliers[i] = 0;
        return;
    }
    if (known && ++points_.outliers[i] < kMostOutliers) return;
    field_.inverseDepth[i] = inverseDepth;
    field_.variance[i] = variance;
    field_.filled[i] = 0;
    points_.reset(i);
}

void DepthFilter::forget(const PixelRect& where) {
    for (int y = where.y0; y < where.y1; ++y)
        field_.forgetRow(y, where.x0, where.x1);
}

void DepthFilter::forgetContradicted(const InverseDepthField& measured, const PixelRect& where) {
    const int rows = (where.y1 - where.y0 + kBlock - 1) / kBlock;
    workers_->forRange(rows, 1, [&](int first, int last) {
        for (int row = first; row < last; ++row) {
            const int y = where.y0 + kBlock * row;
            for (int x = where.x0; x < where.x1; x += kBlock)
                forgetContradictedBlock(measured, common(where, {x, y, x + kBlock, y + kBlock}));
        }
    });
}

void DepthFilter::forgetContradictedBlock(const InverseDepthField& measured,
                                          const PixelRect& block) {
    std::array<std::size_t, static_cast<std::size_t>(kBlock) * kBlock> contradicted{};
    std::size_t count = 0, compared = 0;
    for (int y = block.y0; y < block.y1; ++y) {
        const auto row = static_cast<std::size_t>(y) * field_.size.width;
        for (std::size_t i = row + block.x0; i < row + block.x1; ++i) {
            const float inverseDepth = measured.inverseDepth[i], variance = measured.variance[i];
            if (!field_.isKnown(i) || !InverseDepthField::isSound(inverseDepth, variance)) continue;
            ++compared;
            if (!agrees(i, inverseDepth, variance)) contradicted[count++] = i;
        }
    }
    if (2 * count <= compared) return;
    for (std::size_t k = 0; k < count; ++k)
        field_.forget(contradicted[k]);
}

}  // namespace mfar
