#include "pipeline/render/light_history.h"

#include "pipeline/render/microfacet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr float kNearest = 1e-3F;
// A pixel shows the same surface as a given point if two conditions hold: its surface point is less
// than kOffPlane times its depth away from the tangent plane of the given point, and the cosine of
// the angle between the normals of the two points is at least kSameBend.
constexpr float kOffPlane = 0.01F, kSameBend = 0.9F;
constexpr float kLeastWeight = 0.1F;
// The weight of a specular lobe of width alpha falls to 1/e when the eye moves by the angle
// kLobeTurn * alpha around the point.
constexpr float kLobeTurn = 0.5F;

// Specular light with fewer samples counts as unknown.
constexpr float kLeastCount = 0.01F;

void addFirst(KnownLight& sum, float share, const KnownLight& light) {
    sum.first += share * light.first;
    sum.firstSquare += share * light.firstSquare;
    sum.firstCount += share * light.firstCount;
}
void addSecond(KnownLight& sum, float share, const KnownLight& light) {
    sum.second += share * light.second;
    sum.secondSquare += share * light.secondSquare;
    sum.secondCount += share * light.secondCount;
}

}  // namespace

LightHistory::LightHistory(const Film& film, const RenderView& view,
                           std::shared_ptr<const LensRays> lens, float mostSamples,
                           std::optional<MovedLight> moved)
    : film_(film), camera_(view.camera), lens_(std::move(lens)),
      rotation_(view.T_world_camera.rotation.normalized().toRotationMatrix().cast<float>()),
      eye_(view.T_world_camera.translation.cast<float>()), mostSamples_(mostSamples),
      moved_(std::move(moved)) {}

bool LightHistory::isSame(std::size_t pixel, const Eigen::Vector2f& ray, const SeenSurface& seen,
                          const Eigen::Vector3f& point) const {
    const SeenSurface& there = film_.centre(pixel);
    if (there.hit.id != seen.hit.id || there.normal.dot(seen.normal) < kSameBend) return false;
    const Eigen::Vector3f other = eye_ + there.hit.depth * (rotation_ * ray.homogeneous().eval());
    return std::abs(seen.normal.dot(other - point)) < kOffPlane * there.hit.depth;
}

KnownLight LightHistory::between(const Eigen::Vector2d& pixel, int step, const SeenSurface& seen,
                                 const Eigen::Vector3f& point) const {
    const Size size = camera_.size;
    const Eigen::Vector2d at = pixel / step;
    const double lowX = std::floor(at.x()), lowY = std::floor(at.y());
    const auto fx = static_cast<float>(at.x() - lowX), fy = static_cast<float>(at.y() - lowY);
    KnownLight sum;
    float weights = 0, secondWeights = 0;
    for (int i = 0; i < 4; ++i) {
        const int right = i & 1, down = i >> 1;
        const int x = step * (static_cast<int>(lowX) + right);
        const int y = step * (static_cast<int>(lowY) + down);
        const float weight = (right != 0 ? fx : 1 - fx) * (down != 0 ? fy : 1 - fy);
        if (x < 0 || y < 0 || x >= size.width || y >= size.height || !(weight > 0)) continue;
        const std::size_t place = static_cast<std::size_t>(y) * size.width + x;
        if (!isSame(place, lens_->at(static_cast<float>(x), static_cast<float>(y)), seen, point))
            continue;
        const KnownLight known = film_.known(place);
        if (!(known.firstCount > 0)) continue;
        weights += weight;
        addFirst(sum, weight, known);
        if (!(known.secondCount > 0)) continue;
        secondWeights += weight;
        addSecond(sum, weight, known);
    }
    if (weights < kLeastWeight) return {};
    KnownLight out;
    addFirst(out, 1 / weights, sum);
    if (secondWeights >= kLeastWeight) addSecond(out, 1 / secondWeights, sum);
    return out;
}

bool LightHistory::isSparseAt(const Eigen::Vector2d& pixel) const {
    const auto odd = [](double at, int end) {
        return std::min(2 * (static_cast<int>(at) / 2) + 1, end - 1);
    };
    const int x = odd(std::max(pixel.x(), 0.0), camera_.size.width);
    const int y = odd(std::max(pixel.y(), 0.0), camera_.size.height);
    return !film_.isSeen(static_cast<std::size_t>(y) * camera_.size.width + x);
}

KnownLight LightHistory::at(const SeenSurface& seen, const Eigen::Vector3f& point,
                            const Eigen::Vector3f& eye) const {
    if (!moved_) return found(seen, point, eye);
    SeenSurface before = seen;
    Eigen::Vector3f pointBefore = point, eyeBefore = eye;
    moved_->follow(seen.hit.id, pointBefore, before.normal, eyeBefore);
    KnownLight out = found(before, pointBefore, eyeBefore);
    if (!(out.firstCount > 0)) return out;
    const MovedLight::Change change = moved_->at(seen, point, eye);
    out.firstCount = stillWorth(out.firstCount, change.diffuse);
    // KnownLight::second of the shadow catcher is the light without objects, so it does not change.
    if (seen.hit.id != kCatcherId) out.secondCount = stillWorth(out.secondCount, change.specular);
    return out;
}

KnownLight LightHistory::found(const SeenSurface& seen, const Eigen::Vector3f& point,
                               const Eigen::Vector3f& eye) const {
    const bool catches = seen.hit.id == kCatcherId;
    if (seen.hit.id == 0 || (catches && !knowsCatcher_)) return {};
    const Eigen::Vector3f there = rotation_.transpose() * (point - eye_);
    if (!(there.z() > kNearest)) return {};
    const Eigen::Vector2d pixel = camera_.project(there.hnormalized().cast<double>());
    const Size size = camera_.size;
    if (!(pixel.x() > -1 && pixel.y() > -1 && pixel.x() < size.width && pixel.y() < size.height))
        return {};
    // In parts of the shadow catcher, the earlier picture may have sampled only every second column
    // and row. There, samples 2 px apart are used, and elsewhere adjacent pixels. If this finds no
    // light on the catcher, at the border of such a part, the other spacing is tried.
    const bool isSparse = catches && isSparseAt(pixel);
    KnownLight out = between(pixel, isSparse ? 2 : 1, seen, point);
    if (catches && !(out.firstCount > 0)) out = between(pixel, isSparse ? 1 : 2, seen, point);
    out.firstCount = std::min(out.firstCount, mostSamples_);
    out.secondCount = std::min(out.secondCount, mostSamples_);
    if (catches) return out;
    const float cosine = (point - eye_).normalized().dot((point - eye).normalized());
    const float turn = std::acos(std::clamp(cosine, -1.0F, 1.0F));
    const float lobes = turn / (kLobeTurn * alphaOf(seen.roughness));
    out.secondCount *= std::exp(-lobes * lobes);
    if (out.secondCount < kLeastCount) out.secondCount = 0;
    return out;
}

}  // namespace mfar
