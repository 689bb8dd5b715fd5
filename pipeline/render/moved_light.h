#pragma once

#include "pipeline/render/far_light.h"
#include "pipeline/render/film.h"
#include "pipeline/render/sun_light.h"
#include "pipeline/scene/scene_bounds.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// Tells how far the motion of objects may have changed the light on a surface since an earlier
/// picture. A moved object stands for its bounding ball, which blocks the distant light behind it
/// and may glow. So the changes are estimates, and rather too large than too small.
class MovedLight {
public:
    struct Object {
        std::uint8_t id = 0;
        ObjectBall own;  ///< in the object's frame
        RigidTransform T_world_before, T_world_now;
        float glow = 0;  ///< luminance of its strongest emission
    };
    /// Objects that have not moved may be left out. `sun` and `far` must outlive this object.
    MovedLight(std::span<const Object> objects, const SunLight& sun, const FarLight& far);

    /// Moves a point of an object, its normal and the viewer's position to where they were on the
    /// object before.
    void follow(std::uint8_t id, Eigen::Vector3f& point, Eigen::Vector3f& normal,
                Eigen::Vector3f& eye) const;

    /// Shares of the light on a surface that may have changed, from 0 on; 1: all of it.
    struct Change {
        float diffuse = 0, specular = 0;
    };
    /// `point` and `eye` are in the world, at their places now.
    [[nodiscard]] Change at(const SeenSurface& seen, const Eigen::Vector3f& point,
                            const Eigen::Vector3f& eye) const;
    /// Change of the diffuse light on a surface that is not part of a moved object.
    [[nodiscard]] float diffuseChange(const Eigen::Vector3f& point,
                                      const Eigen::Vector3f& normal) const;

private:
    struct Ball {
        Eigen::Vector3f before, now;
        float radius, turn, glow;
    };
    struct Moved {
        std::uint8_t id;
        Ball ball;
        Eigen::Isometry3f T_before_now;
    };
    /// A moved ball as seen from a point.
    struct Sight;
    [[nodiscard]] const Moved* find(std::uint8_t id) const;
    [[nodiscard]] float blocked(const Sight& sight, const Eigen::Vector3f& normal) const;

    const SunLight& sun_;
    const FarLight& far_;
    std::vector<Moved> moved_;
};

/// Number of independent samples that are worth as much as `count` samples of a light of which the
/// share `change` may have changed since.
[[nodiscard]] float stillWorth(float count, float change);

}  // namespace mfar
