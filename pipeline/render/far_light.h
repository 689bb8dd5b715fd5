#pragma once

#include "base/mirror_light.h"
#include "pipeline/render/environment_light.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mfar {

/// A function of the direction: a row-major table on the octahedral map (Cigolle et al. 2014) that
/// repeats its border, interpolated.
class DirectionTable {
public:
    /// `edge` texels a side, at least 2.
    explicit DirectionTable(int edge);

    [[nodiscard]] int edge() const { return edge_; }
    /// The direction at a texel, unit length.
    [[nodiscard]] Eigen::Vector3f direction(int column, int row) const;
    [[nodiscard]] Eigen::Vector3f& at(int column, int row) {
        return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(edge_) +
                       static_cast<std::size_t>(column)];
    }
    [[nodiscard]] const Eigen::Vector3f& at(int column, int row) const {
        return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(edge_) +
                       static_cast<std::size_t>(column)];
    }
    [[nodiscard]] Eigen::Vector3f operator()(const Eigen::Vector3f& direction) const;

private:
    int edge_;
    std::vector<Eigen::Vector3f> values_;
};

/// The light that would reach a point if there were no objects: the environment above the horizon
/// and, if there is a real surface, a ground of its mean radiance below (world z is up). Does not
/// include the sun. Integrals over it are precomputed in tables: they give a surface's light
/// without a ray, and rays only measure how the objects change it.
class FarLight {
public:
    FarLight(const EnvironmentLight& environment, const Lighting& lighting,
             const ShadowCatcher& catcher);

    [[nodiscard]] bool dark() const { return dark_; }
    /// Mean radiance over all directions and channels.
    [[nodiscard]] float brightness() const { return brightness_; }
    /// Radiance from a direction, given the environment's radiance there.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction,
                                           const Eigen::Vector3f& environment) const {
        return hasGround_ && direction.z() < 0 ? ground_ : environment;
    }
    /// Irradiance on a surface of this normal, divided by pi.
    [[nodiscard]] Eigen::Vector3f diffuse(const Eigen::Vector3f& normal) const {
        return diffuse_(normal);
    }
    /// Mean about `direction` over the lobe that a surface of this roughness reflects, seen along
    /// its normal (Karis 2013). Off the normal the lobe is longer, so this is an approximation.
    [[nodiscard]] Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, float roughness) const;

    /// Tables of mirrored() and, for a mirror, of the light itself; without the sun.
    [[nodiscard]] MirrorLight tables() const;

private:
    /// Light by direction, at decreasing resolution; the tables are computed from it.
    using Pyramid = std::vector<DirectionTable>;
    [[nodiscard]] Pyramid pyramid() const;
    void makeDiffuse(const Pyramid& light);
    void makeMirrored(const Pyramid& light);

    const EnvironmentLight& environment_;
    bool dark_, hasGround_;
    float brightness_ = 0;
    Eigen::Vector3f ground_{0, 0, 0};
    DirectionTable diffuse_;
    std::vector<DirectionTable> mirrored_;  // one for each of kMirrorLevels
};

}  // namespace mfar
