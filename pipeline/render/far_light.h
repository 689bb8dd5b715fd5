#pragma once

#include "base/mirror_light.h"
#include "pipeline/render/environment_light.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mfar {

/// An interpolated function of a direction, stored as a row-major table on the octahedral map
/// (Cigolle et al. 2014). Each direction on the border of the table has two texels.
class DirectionTable {
public:
    /// `edge`: texels per side, at least 2.
    explicit DirectionTable(int edge);

    [[nodiscard]] int edge() const { return edge_; }
    /// Direction of a texel, of unit length.
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

/// Light that would reach a point if there were no objects. Above the horizon it comes from the
/// environment. Below the horizon it comes from a ground of uniform radiance if the scene has a
/// shadow catcher (world z is up). The sun's direct light is not included.
/// Integrals over this light are precomputed in tables, so that a surface's light is known without
/// tracing a ray. Rays are traced only to measure how the objects change the light.
class FarLight {
public:
    FarLight(const EnvironmentLight& environment, const Lighting& lighting,
             const ShadowCatcher& catcher);

    [[nodiscard]] bool dark() const { return dark_; }
    /// Mean radiance over all directions and colour channels.
    [[nodiscard]] float brightness() const { return brightness_; }
    /// Radiance from a direction. `environment` is the environment's radiance from there.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3f& direction,
                                           const Eigen::Vector3f& environment) const {
        return hasGround_ && direction.z() < 0 ? ground_ : environment;
    }
    /// Irradiance on a surface with this normal, divided by pi.
    [[nodiscard]] Eigen::Vector3f diffuse(const Eigen::Vector3f& normal) const {
        return diffuse_(normal);
    }
    /// Mean radiance about `direction`, weighted with the lobe that a surface of this roughness
    /// reflects when seen along its normal (Karis 2013). At other angles the true lobe is longer,
    /// so the result is an approximation.
    [[nodiscard]] Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, float roughness) const;

    /// Returns tables of mirrored() and, for roughness 0, of the light itself. The tables do not
    /// contain the sun.
    [[nodiscard]] MirrorLight tables() const;

private:
    /// Light by direction, at decreasing resolution. The other tables are computed from the
    /// pyramid.
    using Pyramid = std::vector<DirectionTable>;
    [[nodiscard]] Pyramid pyramid() const;
    void makeDiffuse(const Pyramid& light);
    void makeMirrored(const Pyramid& light);

    const EnvironmentLight& environment_;
    bool dark_, hasGround_;
    float brightness_ = 0;
    Eigen::Vector3f ground_{0, 0, 0};
    DirectionTable diffuse_;
    std::vector<DirectionTable> mirrored_;  // one table for each of kMirrorLevels
};

}  // namespace mfar
