#pragma once

#include "pipeline/render/light_sample.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <vector>

namespace mfar {

/// Light from an environment picture, interpolated between texels.
/// The probability density of a sampled direction is constant on each texel (Pharr, Jakob,
/// Humphreys, Physically Based Rendering, 12.5). It is proportional to the excess of the texel's
/// luminance over the mean luminance of all directions. Light up to the mean is found better by
/// sampling the surface's reflection (MIS compensation, Karlik et al. 2019). A uniform picture is
/// not sampled at all.
class EnvironmentLight {
public:
    /// If `environment` is null, this light is dark.
    explicit EnvironmentLight(std::shared_ptr<const Environment> environment);

    [[nodiscard]] bool dark() const { return dark_; }
    /// Whether sample() may be called. Dark and uniform pictures are not sampled.
    [[nodiscard]] bool sampled() const { return sampled_; }
    [[nodiscard]] LightSample sample(const Eigen::Vector2f& u) const;
    /// `direction` must have unit length.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
    [[nodiscard]] float density(const Eigen::Vector3f& direction) const;

private:
    /// Position of a direction in the picture [texels]. The outer corner of the first texel is at
    /// (0, 0).
    [[nodiscard]] Eigen::Vector2f place(const Eigen::Vector3f& direction) const;
    [[nodiscard]] Eigen::Vector3f interpolated(const Eigen::Vector2f& at) const;
    [[nodiscard]] float density(int column, int row) const;
    [[nodiscard]] float meanBrightness(int column, int row) const;
    [[nodiscard]] float heightOf(int row) const { return tops_[static_cast<std::size_t>(row)]; }

    std::shared_ptr<const Environment> environment_;
    Size size_;
    // World z of the unit directions on each row's upper edge. The last entry is for the last row's
    // lower edge.
    std::vector<float> tops_;
    std::vector<float> rows_;    // cumulative probability of the rows, from 0 to 1
    std::vector<float> texels_;  // for each row: cumulative probability of texels, width + 1 values
    bool dark_ = true, sampled_ = false;
};

}  // namespace mfar
