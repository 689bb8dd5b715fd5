#include "pipeline/track/tag_pose.h"

#include "pipeline/track/pose_refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace mfar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kStarts = 8;  // number of largest tags whose solutions bestStart() compares
// Robust weights of tags depend on each tag's rms error, relative to a scale that decreases. This
// is the scale at the start [px]. It is large, because the first pose comes from a single tag and
// is inaccurate for distant tags.
constexpr double kStartCutoff = 10;
constexpr double kSameMinimum = 0.1 * kDegree;

struct Candidate {
    std::size_t index;
    double area;
    CornerSet corners;
    std::array<RigidTransform, 2> T_world_camera;
};

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Returns the area of a tag's quad [px^2]. Returns 0 if the quad is too small, is partly outside
/// the picture, or cannot be a tag seen from its front.
double usableArea(const TagObservation& tag, const CameraModel& camera, double smallestEdge) {
    const auto& c = tag.corners;
    double area = 0;
    for (int k = 0; k < 4; ++k) {
        if (!(c[k].x() >= -0.5 && c[k].y() >= -0.5 && c[k].x() <= camera.size.width - 0.5 &&
              c[k].y() <= camera.size.height - 0.5))
            return 0;
        const Vector2d edge = c[(k + 1) % 4] - c[k], next = c[(k + 2) % 4] - c[(k + 1) % 4];
        // y points down in the picture, so the edges of a valid quad turn by negative angles.
        if (!(cross(edge, next) < 0) || !(edge.norm() >= smallestEdge)) return 0;
        area -= cross(c[k], c[(k + 1) % 4]) / 2;
    }
    return area;
}

std::optional<Candidate> examine(std::size_t index, const TagObservation& tag,
                                 const CameraModel& camera, const TagPoseOptions& options) {
    const auto T_world_tag = soundMotion(tag.T_world_tag);
    if (!(tag.size > 0) || !std::isfinite(tag.size) || !T_world_tag) return std::nullopt;
    Candidate out{index, usableArea(tag, camera, options.smallestEdge), {}, {}};
    if (!(out.area > 0)) return std::nullopt;
    std::array<Vector2d, 4> rays;
    for (int k = 0; k < 4; ++k)
        rays[k] = camera.unproject(tag.corners[k]);
    const auto poses = planarPoses(rays);
    if (!poses) return std::nullopt;
    for (int i = 0; i < 2; ++i) {
        RigidTransform T_camera_tag = (*poses)[i];
        const double facing =
            (T_camera_tag.rotation * Vector3d::UnitZ()).dot(T_camera_tag.translation.normalized());
        if (!(facing > std::cos(options.grazingAngleDeg * kDegree))) return std::nullopt;
        T_camera_tag.translation *= tag.size / 2;
        out.T_world_camera[i] = *T_world_tag * T_camera_tag.inverse();
    }
    out.corners.pixels = tag.corners;
    out.corners.outwards = outwardsOf(tag.corners);
    for (int k = 0; k < 4; ++k) {
        const Vector2d corner = kTagCorners[k] * tag.size / 2;
        out.corners.world[k] = *T_world_tag * Vector3d(corner.x(), corner.y(), 0);
    }
    return out;
}

double cappedError(std::span<const CornerSet> sets, const RigidTransform& T_world_camera,
                   const CameraModel& camera) {
    const RigidTransform inverse = T_world_camera.inverse();
    double sum = 0;
    for (const CornerSet& set : sets)
        sum += std::min(squaredError(set, inverse, camera), 4 * kStartCutoff * kStartCutoff);
    return sum;
}

/// Returns the pose that fits all tags best. The candidates are the two solutions of each of the
/// kStarts largest tags. If two candidates fit equally well, that of the larger tag is returned.
RigidTransform bestStart(std::span<const Candidate> tags, std::span<const CornerSet> sets,
                         const CameraModel& camera) {
    RigidTransform best = tags[0].T_world_camera[0];
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& tag : tags.first(std::min(tags.size(), kStarts)))
        for (const RigidTransform& T : tag.T_world_camera) {
            const double error = cappedError(sets, T, camera);
            if (error < 0.999 * least) {
                least = error;
                best = T;
            }
        }
    return best;
}

/// Sets the weight of each tag to 1 if the rms error of its corners is at most `cutoff` [px], else
/// to 0. Returns false if all weights are 0.
bool keepFitting(std::span<CornerSet> sets, const RigidTransform& T_world_camera,
                 const CameraModel& camera, double cutoff) {
    const RigidTransform inverse = T_world_camera.inverse();
    bool any = false;
    for (CornerSet& set : sets) {
        set.weight = squaredError(set, inverse, camera) <= 4 * cutoff * cutoff ? 1 : 0;
        any = any || set.weight > 0;
    }
    return any;
}

/// Minimises the error over all tags that agree with each other, starting from the pose `T` of one
/// tag. At first, tags with larger errors have smaller weights (Geman-McClure), and the scale of
/// the errors decreases. At the end, each weight is 1 or 0.
std::optional<RefinedPose> refineRobustly(std::span<CornerSet> sets, RigidTransform T,
                                          const CameraModel& camera, double farthest) {
    for (const double scale : {kStartCutoff, 0.5 * (kStartCutoff + farthest), farthest}) {
        if (sets.size() == 1) break;
        const RigidTransform inverse = T.inverse();
        for (CornerSet& set : sets) {
            const double share = squaredError(set, inverse, camera) / (4 * scale * scale);
            set.weight = std::isfinite(share) ? 1 / ((1 + share) * (1 + share)) : 0;
        }
        const auto refined = refinePose(sets, T, camera);
        if (!refined) return std::nullopt;
        T = refined->T_world_camera;
    }
    std::optional<RefinedPose> refined;
    for (int turn = 0; turn < 2; ++turn) {
        if (sets.size() > 1 && !keepFitting(sets, T, camera, farthest)) return std::nullopt;
        refined = refinePose(sets, T, camera);
        if (!refined) return std::nullopt;
        T = refined->T_world_camera;
    }
    return refined;
}

std::optional<CameraPose> finish(RefinedPose refined, std::span<const CornerSet> sets, int tags,
                                 const CameraModel& camera, const TagPoseOptions& options) {
    if (tags > 1) {
        const double share = options.cornerSigma / options.edgeShiftSigma;
        const auto freed = refinePose(sets, refined.T_world_camera, camera, share * share);
        if (!freed) return std::nullopt;
        refined = *freed;
    }
    const auto inverse = inverseOf(refined.information);
    if (!inverse) return std::nullopt;
    CameraPose out;
    out.edgeShift = refined.edgeShift;
    out.T_world_camera = refined.T_world_camera;
    out.squaredError = refined.squaredError;
    out.tags = tags;
    const double variance = refined.squaredError / (8 * tags - (tags > 1 ? 7 : 6));
    out.covariance = std::max(options.cornerSigma * options.cornerSigma, variance) * *inverse;
    return out;
}

bool sameMinimum(const RigidTransform& a, const RigidTransform& b) {
    return a.rotation.angularDistance(b.rotation) < kSameMinimum;
}

/// Finds the second local minimum of the error over the used tags. The starting points are the two
/// solutions of the largest used tag. Returns nothing if both lead to the pose `best`.
std::optional<RefinedPose> otherMinimum(std::span<const Candidate> tags,
                                        std::span<const CornerSet> sets, const RefinedPose& best,
                                        const CameraModel& camera) {
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (!(sets[i].weight > 0)) continue;
        for (const RigidTransform& start : tags[i].T_world_camera) {
            const auto refined = refinePose(sets, start, camera);
            if (refined && !sameMinimum(refined->T_world_camera, best.T_world_camera))
                return refined;
        }
        return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

double CameraPose::rms() const {
    return tags > 0 ? std::sqrt(squaredError / (4 * tags)) : 0;
}

std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                        const CameraModel& camera, const TagPoseOptions& options) {
    std::vector<Candidate> fit;
    for (std::size_t i = 0; i < tags.size(); ++i)
        if (auto one = examine(i, tags[i], camera, options)) fit.push_back(std::move(*one));
    if (fit.empty()) return std::nullopt;
    std::sort(fit.begin(), fit.end(), [](const Candidate& a, const Candidate& b) {
        return std::pair(-a.area, a.index) < std::pair(-b.area, b.index);
    });
    std::vector<CornerSet> sets;
    for (const Candidate& one : fit)
        sets.push_back(one.corners);
    auto best = refineRobustly(sets, bestStart(fit, sets, camera), camera, options.farthestCorner);
    if (!best) return std::nullopt;
    CameraPoses out;
    out.used.assign(tags.size(), false);
    int used = 0;
    for (std::size_t i = 0; i < fit.size(); ++i) {
        if (!(sets[i].weight > 0)) continue;
        out.used[fit[i].index] = true;
        ++used;
    }
    auto other = otherMinimum(fit, sets, *best, camera);
    if (other && other->squaredError < best->squaredError) std::swap(*other, *best);
    const auto finished = finish(*best, sets, used, camera, options);
    if (!finished || !(finished->rms() <= options.farthestCorner)) return std::nullopt;
    out.best = *finished;
    if (other) out.other = finish(*other, sets, used, camera, options);
    // finish() estimates the edge shift, which can exchange the order of the errors.
    if (out.other && out.other->squaredError < out.best.squaredError)
        std::swap(out.best, *out.other);
    return out;
}

}  // namespace mfar
