#pragma once

#include "base/mirror_light.h"
#include "pipeline/render/environment_light.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mfar {

/// An interpolated function of direction, stored as a row-major table on the octahedral map
/// (Cigolle et al. 2014). Most directions on the border of the table have two texels; the direction
/// -z has the four corners.
class DirectionTable {
public:
    /// `edge` is the number of texels per side, at least 2.
    explicit DirectionTable(int edge);

    [[nodiscard]] int edge() const { return edge_; }
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

/// Light that would reach a point if there were no objects. Light from above the horizon comes from
/// the environment. If the scene has a shadow catcher, light from below the horizon (world z < 0)
/// comes from a ground of uniform radiance. The sun's direct light is not included.
/// Precomputed tables of integrals give this light without tracing a ray. So rays need only measure
/// how objects change the light.
class FarLight {
public:
    FarLight(const EnvironmentLight& environment, const Lighting& lighting,
             const ShadowCatcher& catcher);

    [[nodiscard]] bool dark() const { return dark_; }
    [[nodiscard]] float brightness() const { return brightness_; }
    /// Returns the light from `direction`. `environment` is the environment's radiance from there.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction,
                                           const Eigen::Vector3f& environment) const {
        return hasGround_ && direction.z() < 0 ? ground_ : environment;
    }
    /// Returns the irradiance on a surface with this normal, divided by pi.
    [[nodiscard]] Eigen::Vector3f diffuse(const Eigen::Vector3f& normal) const {
        return diffuse_(normal);
    }
    /// Returns the mean radiance around `direction`, weighted with the reflection lobe of this
    /// roughness at normal incidence (Karis 2013). At other angles the lobe is longer, so the
    /// result is an approximation.
    [[nodiscard]] Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, float roughness) const;

    /// Returns tables of mirrored(). The table of roughness 0 contains the unfiltered light. No
    /// table contains the sun.
    [[nodiscard]] MirrorLight tables() const;

private:
    /// Light by direction, at decreasing resolution. makeDiffuse() and makeMirrored() integrate
    /// over it.
    using Pyramid = std::vector<DirectionTable>;
    [[nodiscard]] Pyramid pyramid() const;
    void makeDiffuse(const Pyramid& light);
    void makeMirrored(const Pyramid& light);

    const EnvironmentLight& environment_;
    bool dark_, hasGround_;
    float brightness_ = 0;
    Eigen::Vector3f ground_{0, 0, 0};
    DirectionTable diffuse_;
    std::vector<DirectionTable> mirrored_;
};

}  // namespace mfar
