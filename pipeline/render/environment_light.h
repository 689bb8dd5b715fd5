#pragma once

#include "pipeline/render/light_sample.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <vector>

namespace mfar {

/// Light from an environment picture, interpolated between its texels. Directions are sampled from
/// a density that is constant on each texel (Pharr, Jakob, Humphreys, Physically Based Rendering,
/// 12.5) and proportional to the part of its luminance above the mean over all directions: the
/// surface's own samples find the rest better, because they follow its reflection (MIS
/// compensation, Karlik et al. 2019). An even picture is not sampled at all.
class EnvironmentLight {
public:
    /// Null: no light.
    explicit EnvironmentLight(std::shared_ptr<const Environment> environment);

    [[nodiscard]] bool dark() const { return dark_; }
    /// Whether sample() returns any light.
    [[nodiscard]] bool sampled() const { return sampled_; }
    [[nodiscard]] LightSample sample(const Eigen::Vector2f& u) const;
    /// `direction` of unit length.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
    [[nodiscard]] float density(const Eigen::Vector3f& direction) const;

private:
    /// Position of a direction in the picture [texels]; the first texel's corner is at 0.
    [[nodiscard]] Eigen::Vector2f place(const Eigen::Vector3f& direction) const;
    [[nodiscard]] Eigen::Vector3f interpolated(const Eigen::Vector2f& at) const;
    [[nodiscard]] float density(int column, int row) const;
    [[nodiscard]] float meanBrightness(int column, int row) const;
    [[nodiscard]] float heightOf(int row) const { return tops_[static_cast<std::size_t>(row)]; }

    std::shared_ptr<const Environment> environment_;
    Size size_;
    std::vector<float> tops_;    // world z of each row's upper edge, then of the last row's lower
                                 // edge
    std::vector<float> rows_;    // cumulative share of the rows above, 0 first, 1 last
    std::vector<float> texels_;  // in each row, cumulative share of the texels to the left: width +
                                 // 1 values
    bool dark_ = true, sampled_ = false;
};

}  // namespace mfar
