#pragma once

#include "pipeline/render/light_sample.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <vector>

namespace mfar {

/// Light from an environment picture, interpolated between texels. The probability density of a
/// sampled direction is constant on each texel (Pharr, Jakob, Humphreys, Physically Based
/// Rendering, 12.5). It is proportional to the excess of the texel's luminance over the mean
/// luminance of all directions. Texels darker than the mean are not sampled here. Samples of the
/// surface's reflection find their weak light better (MIS compensation, Karlik et al. 2019). A
/// uniform picture is not sampled.
class EnvironmentLight {
public:
    explicit EnvironmentLight(std::shared_ptr<const Environment> environment);

    [[nodiscard]] bool dark() const { return dark_; }
    /// True if sample() may be called. It is false for dark and for uniform pictures.
    [[nodiscard]] bool sampled() const { return sampled_; }
    [[nodiscard]] LightSample sample(const Eigen::Vector2f& u) const;
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
    /// Returns the probability density [1/sr] with which sample() gives `direction`.
    [[nodiscard]] float density(const Eigen::Vector3f& direction) const;
    struct Seen {
        Eigen::Vector3f radiance{0, 0, 0};
        float density = 0;
    };
    /// Returns radiance() and density() of `direction`, in less time than the two functions take.
    [[nodiscard]] Seen seen(const Eigen::Vector3f& direction) const;

private:
    /// Converts a direction to a position in the picture [texels]. (0, 0) is the picture's corner.
    [[nodiscard]] Eigen::Vector2f place(const Eigen::Vector3f& direction) const;
    [[nodiscard]] Eigen::Vector3f interpolated(const Eigen::Vector2f& at) const;
    [[nodiscard]] float densityAt(const Eigen::Vector2f& at) const;
    [[nodiscard]] float density(int column, int row) const;
    [[nodiscard]] float meanBrightness(int column, int row) const;
    [[nodiscard]] float heightOf(int row) const { return tops_[static_cast<std::size_t>(row)]; }

    std::shared_ptr<const Environment> environment_;
    Size size_;
    // World z of the unit directions on each row's upper edge. The last entry belongs to the lower
    // edge of the last row.
    std::vector<float> tops_;
    std::vector<float> rows_;    // cumulative probability of the rows, from 0 to 1
    std::vector<float> texels_;  // cumulative probability in each row (width + 1 values)
    bool dark_ = true, sampled_ = false;
};

}  // namespace mfar
