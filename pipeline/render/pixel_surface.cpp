#include "pipeline/render/pixel_surface.h"

#include "base/luminance.h"
#include "pipeline/render/microfacet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar {
namespace {

// The mean of normals that cancel each other has no useful direction. A mean is used only if it is
// at least this long.
constexpr float kLeastMean = 0.1F;
// A pixel's surface is first examined at three points: the pixel's centre and kFirst. These points
// send mirrored light to the eye. If this light deviates from its mean by more than kContrast times
// the brightness of the distant light, the six points of kRest are added. All nine points form a
// grid of 3 x 3. Pictures of the model "showpiece" are not better if all pixels have nine points,
// because less time is left for samples. They are worse if the distant light is looked up only once
// per pixel, with a lobe widened by the spread of the normals: where normals differ by more than
// the lobe's width, their mirrored light is no single lobe.
constexpr float kContrast = 0.05F;
constexpr float kThird = 1.0F / 3;
constexpr std::array<PixelOffset, 2> kFirst = {{{-kThird, -kThird}, {kThird, kThird}}};
constexpr std::array<PixelOffset, 6> kRest = {
    {{kThird, -kThird}, {-kThird, kThird}, {0, -kThird}, {-kThird, 0}, {kThird, 0}, {0, kThird}}};
constexpr std::size_t kMostAtOnce = kRest.size();

}  // namespace

/// Sums over points of an object.
class PixelSurfaces::Mean {
public:
    void add(const SurfacePoint& point, const SurfaceLight& far, const Paint& paint) {
        const PaintWeights weights = weightsOf(paint);
        far_.diffuse += weights.diffuse * far.diffuse;
        far_.specular += weights.specular * far.specular;
        const float mirrored = luminanceOf(far.specular);
        squares_ += weights.specular * mirrored * mirrored;
        weights_.diffuse += weights.diffuse;
        weights_.specular += weights.specular;
        normals_ += point.shading;
        ++count_;
    }

    /// Standard deviation of the mirrored light that the points send to the eye.
    [[nodiscard]] float deviation() const {
        const float mean = luminanceOf(far_.specular) / weights_.specular;
        const float variance = squares_ / weights_.specular - mean * mean;
        return std::sqrt(std::max(variance, 0.0F)) * weights_.specular / count_;
    }

    [[nodiscard]] SurfaceLight far() const {
        return {far_.diffuse / weights_.diffuse, far_.specular / weights_.specular};
    }

    /// Replaces the normal of `point` by the mean normal. Raises the roughness with the spread of
    /// the normals (Toksvig 2005).
    void smooth(SurfacePoint& point) const {
        const float length = normals_.norm();
        if (!(length > kLeastMean * count_)) return;
        point.shading = normals_ / length;
        // The spread of a few normals is too small on average. The factor count / (count - 1)
        // corrects this.
        const float spread = count_ > 1 ? (1 - length / count_) * count_ / (count_ - 1) : 0;
        const float alpha = alphaOf(point.look.roughness);
        point.look.roughness = std::min(1.0F, std::sqrt(std::sqrt(alpha * alpha + 2 * spread)));
    }

private:
    SurfaceLight far_;
    PaintWeights weights_{0, 0};
    float squares_ = 0, count_ = 0;
    Eigen::Vector3f normals_{0, 0, 0};
};

void PixelSurfaces::add(const Eigen::Vector2f& pixel, std::span<const PixelOffset> offsets,
                        std::uint8_t id, Mean& mean) const {
    std::array<Ray, kMostAtOnce> rays;
    std::array<RayHit, kMostAtOnce> hits;
    for (std::size_t i = 0; i < offsets.size(); ++i)
        rays[i] = rays_.at(pixel + Eigen::Vector2f(offsets[i].x, offsets[i].y));
    scene_.objects().firstOfEach(std::span(rays).first(offsets.size()),
                                 std::span(hits).first(offsets.size()));
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const RayHit hit = scene_.shown(rays[i], hits[i]);
        if (!hit.found() || scene_.idOf(hit) != id) continue;
        const Eigen::Vector3f& direction = rays[i].direction;
        const SurfacePoint point = scene_.objectPoint(hit, direction);
        mean.add(point, integrator_.far(point, direction), point.paint(direction));
    }
}

SeenSurface PixelSurfaces::at(const Eigen::Vector2f& pixel, const Ray& ray,
                              const RayHit& hit) const {
    const std::uint8_t id = scene_.idOf(hit);
    SurfacePoint point = scene_.objectPoint(hit, ray.direction);
    SurfaceLight far = integrator_.far(point, ray.direction);
    if (!scene_.isEven(hit, rays_.pixelWidth(hit.t))) {
        Mean mean;
        mean.add(point, far, point.paint(ray.direction));
        add(pixel, kFirst, id, mean);
        if (mean.deviation() > kContrast * integrator_.farBrightness()) add(pixel, kRest, id, mean);
        far = mean.far();
        mean.smooth(point);
    }
    return {{hit.t, id}, point.shading, point.paint(ray.direction), point.look.roughness, far};
}

}  // namespace mfar
