#include "pipeline/epipolar/field_prediction.h"

#include "pipeline/epipolar/near_plane.h"
#include "pipeline/simd/cell_flow_rows.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr int kCellLevel = 2;  // a pixel of this pyramid level is a cell
constexpr float kUnknown = -1e9F;
// Gaps at the picture's border and at depth edges are filled from their edges inwards, up to this
// number of cells. This suffices for motions of 12 px per frame.
constexpr int kWidestGap = 3;

}  // namespace

FieldPrediction::FieldPrediction(const CameraModel& video) : cells_(video, kCellLevel) {}

void FieldPrediction::keep(std::span<const float> s, const RigidTransform& T_still_frame,
                           double unit) {
    kept_.assign(s.begin(), s.end());
    keptPose_ = T_still_frame;
    unit_ = unit;
}

std::span<const float> FieldPrediction::in(const RigidTransform& T_still_frame, double unit) {
    if (kept_.empty()) return {};
    land(T_still_frame, unit);
    return fillGaps() ? std::span<const float>(landed_) : std::span<const float>();
}

// Moves the points of the stored cells to the new pose. Points are homogeneous, (x, y, z, s), so
// that points at infinity (s = 0) need no special case.
void FieldPrediction::land(const RigidTransform& T_still_frame, double unit) {
    RigidTransform T_still_next = T_still_frame, T_still_last = keptPose_;
    T_still_next.translation *= unit / unit_;
    const RigidTransform T_next_last = T_still_next.inverse() * T_still_last;
    const auto behind = [](const RigidTransform& T_still) {
        return static_cast<float>((T_still.rotation.conjugate() * T_still.translation).z());
    };
    simd::CellMotion motion{cells_.lens(),
                            {},
                            behind(T_still_last),
                            behind(T_still_next),
                            static_cast<float>(unit / unit_),
                            static_cast<float>(kNearPlane)};
    const Eigen::Matrix3d R = T_next_last.rotation.toRotationMatrix();
    for (int i = 0; i < 9; ++i)
        motion.motion.turn[i] = static_cast<float>(R(i / 3, i % 3));
    for (int i = 0; i < 3; ++i)
        motion.motion.move[i] = static_cast<float>(T_next_last.translation[i]);
    landing_.resize(kept_.size());
    moved_.resize(kept_.size());
    simd::predictCells(motion, cells_.raysX().data(), cells_.raysY().data(), kept_.data(),
                       kept_.size(), cells_.size(), landing_.data(), moved_.data());
    landed_.assign(kept_.size(), kUnknown);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        if (landing_[i] < 0) continue;
        float& to = landed_[static_cast<std::size_t>(landing_[i])];
        to = std::max(to, moved_[i]);
    }
}

// Fills cells to which no point moved. Such a cell often lies beside a depth edge and shows an area
// that was occluded before, so it gets the depth of the farthest surface next to it. Returns false
// if a gap is too wide.
bool FieldPrediction::fillGaps() {
    const Size size = cells_.size();
    for (int round = 0; round < kWidestGap; ++round) {
        filled_ = landed_;
        bool whole = true;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
                if (landed_[i] > kUnknown) continue;
                float least = -kUnknown;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, size.height - 1); ++v)
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, size.width - 1); ++u) {
                        const float n = landed_[static_cast<std::size_t>(v) * size.width + u];
                        if (n > kUnknown) least = std::min(least, n);
                    }
                if (least < -kUnknown)
                    filled_[i] = least;
                else
                    whole = false;
            }
        }
        landed_.swap(filled_);
        if (whole) return true;
    }
    return false;
}

}  // namespace mfar
