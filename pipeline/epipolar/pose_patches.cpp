#include "pipeline/epipolar/pose_patches.h"

#include "pipeline/epipolar/patch_match.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mfar {
namespace {

// A patch is searched at most this far from its epipolar line [px of the searched pyramid level].
constexpr int kMostSteps = 8;

/// Searches patches at half size and refines their matches at full size.
class PatchSearch {
public:
    PatchSearch(const TurnedPair& full, const TurnedPair& half, const PatchPrior& prior)
        : full_(full), half_(half), prior_(prior), atHalf_(half.video, half.still, half.seen),
          atFull_(full.video, full.still, full.seen),
          scale_(half.video.size.width < full.video.size.width ? 2 : 1) {}

    [[nodiscard]] std::optional<RayMatch> match(PatchPlace place) const {
        const Eigen::Vector2d ray =
            prior_.camera.unproject(toFull(place.middle()), rayNear(place.middle()));
        const auto found = atHalf_.find(place, windowFor(place, ray));
        if (!found) return std::nullopt;
        const auto placed = atHalf_.polish(place, *found);
        if (!placed) return std::nullopt;
        Eigen::Vector2d seen = toFull(*placed + originOf(half_));
        if (scale_ > 1) {
            // `inner` is the patch at full size that has the same middle as the patch at half size.
            // If `inner` cannot be matched, the match at half size is used.
            const PatchPlace inner{2 * place.x + kPatch / 2, 2 * place.y + kPatch / 2};
            if (const auto finer = atFull_.polish(inner, seen - originOf(full_)))
                seen = *finer + originOf(full_);
        }
        return RayMatch{ray, prior_.camera.unproject(seen, ray)};
    }

private:
    static Eigen::Vector2d originOf(const TurnedPair& pair) {
        return {pair.origin.x, pair.origin.y};
    }

    [[nodiscard]] Eigen::Vector2d toFull(const Eigen::Vector2d& pixel) const {
        return ((pixel.array() + 0.5) * scale_ - 0.5).matrix();
    }

    /// Returns the ray of a pixel at most one pixel away from the point, along each axis. The point
    /// is a position in the picture of half size and must be inside it.
    [[nodiscard]] Eigen::Vector2d rayNear(const Eigen::Vector2d& point) const {
        const auto pixel = static_cast<std::size_t>(point.y()) * half_.lens.size().width +
                           static_cast<std::size_t>(point.x());
        return {half_.lens.rayX(pixel), half_.lens.rayY(pixel)};
    }

    [[nodiscard]] Eigen::Vector2d pointAt(const Eigen::Vector2d& ray, double s) const {
        const Eigen::Vector3d& t = prior_.pose.translation;
        const Eigen::Vector2d moved = ray + s * (t.head<2>() - ray * t.z());
        const auto p =
            half_.lens.project(static_cast<float>(moved.x()), static_cast<float>(moved.y()));
        return {p.x, p.y};
    }

    [[nodiscard]] PatchWindow windowFor(PatchPlace place, const Eigen::Vector2d& ray) const {
        PatchWindow out{{}, {1, 0}, 0, 0};
        double s = 0;
        if (prior_.pixelsPerUnit > 0) {
            s = prior_.sAt(toFull(place.middle()));
            const double ahead = s + kAlongSlack / prior_.pixelsPerUnit;
            const Eigen::Vector2d way = pointAt(ray, ahead) - pointAt(ray, s);
            const double length = way.norm();
            out.alongSteps =
                static_cast<int>(std::min(std::ceil(length - 0.01), 1.0 * kAlongSlack));
            if (length > 0) out.along = way / length;
        }
        const Eigen::Vector2d expected = pointAt(ray, s);
        const Eigen::Vector2d seen = prior_.camera.unproject(toFull(expected), ray);
        const Eigen::Matrix2d spread = spreadOf({ray, seen}, prior_.pose);
        out.middle = expected - originOf(half_);
        const Eigen::Vector2d across(-out.along.y(), out.along.x());
        out.acrossSteps = stepsFor(across.dot(spread * across));
        // If the error of s requires at most one step along the line, the pixel is near the
        // epipole. There, the error of the prior pose can require more steps, so the number of
        // steps is computed from the error of the prior pose.
        if (out.alongSteps <= 1) out.alongSteps = stepsFor(out.along.dot(spread * out.along));
        return out;
    }

    /// Returns the number of steps of one pixel that cover three standard deviations. The unit of
    /// `variance` is that of squared rays (x/z, y/z).
    [[nodiscard]] int stepsFor(double variance) const {
        const double pixels = 3 * std::sqrt(variance) * prior_.camera.fx / scale_;
        return pixels < kMostSteps ? std::max(1, static_cast<int>(std::ceil(pixels))) : kMostSteps;
    }

    const TurnedPair& full_;
    const TurnedPair& half_;
    const PatchPrior& prior_;
    PatchMatcher atHalf_, atFull_;
    int scale_;
};

}  // namespace

std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                   const PatchPrior& prior, Workers& workers) {
    const PatchSearch search(full, half, prior);
    const std::vector<PatchPlace> places = texturedPlaces(half.video, prior.noise);
    std::vector<std::optional<RayMatch>> found(places.size());
    workers.forRange(static_cast<int>(places.size()), 16, [&](int first, int last) {
        for (int i = first; i < last; ++i)
            found[i] = search.match(places[i]);
    });
    std::vector<RayMatch> out;
    for (const auto& match : found)
        if (match) out.push_back(*match);
    return out;
}

}  // namespace mfar
