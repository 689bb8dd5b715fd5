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

/// Estimates how much the motion of objects may have changed the light on a surface since an
/// earlier picture. A moved object is approximated by its bounding ball, which blocks the distant
/// light behind it and can glow. The estimates tend to be too large.
class MovedLight {
public:
    struct Object {
        std::uint8_t id = 0;
        ObjectBall own;  ///< bounding ball in the object's frame
        RigidTransform T_world_before, T_world_now;
        float glow = 0;  ///< luminance of the object's strongest emission
    };
    /// Objects that have not moved may be left out. `sun` and `far` must outlive this object.
    MovedLight(std::span<const Object> objects, const SunLight& sun, const FarLight& far);

    /// Undoes the motion of object `id` since the earlier picture: applies T_world_before *
    /// T_world_now^-1 to the point, the normal and the viewer's position `eye`. Changes nothing if
    /// the object did not move.
    void follow(std::uint8_t id, Eigen::Vector3f& point, Eigen::Vector3f& normal,
                Eigen::Vector3f& eye) const;

    /// Change of the light on a surface as a share of this light. 0: unchanged; 1 or more: all of
    /// it may have changed.
    struct Change {
        float diffuse = 0, specular = 0;
    };
    /// `point` and `eye` are the present positions of the surface point and of the viewer in the
    /// world.
    [[nodiscard]] Change at(const SeenSurface& seen, const Eigen::Vector3f& point,
                            const Eigen::Vector3f& eye) const;
    /// Change of the diffuse light on a surface that is not part of a moved object.
    [[nodiscard]] float diffuseChange(const Eigen::Vector3f& point,
                                      const Eigen::Vector3f& normal) const;

private:
    struct Ball {
        Eigen::Vector3f before, now;
        float radius, turn, glow;
        /// Motion [radii].
        [[nodiscard]] float way() const;
        /// Share of the ball's disc that becomes visible or hidden by the motion.
        [[nodiscard]] float fresh() const;
    };
    struct Moved {
        std::uint8_t id;
        Ball ball;
        Eigen::Isometry3f T_before_now;
        std::vector<Ball> others;  ///< other moved objects, and their motion relative to this one
    };
    /// A moved ball as seen from a point.
    struct Sight;
    [[nodiscard]] const Moved* find(std::uint8_t id) const;
    [[nodiscard]] static std::vector<Ball> othersOf(const Moved& own, std::span<const Moved> moved);
    [[nodiscard]] float diffuseChange(std::span<const Ball> balls, const Eigen::Vector3f& point,
                                      const Eigen::Vector3f& normal) const;
    struct Blocked {
        float sky = 0, sun = 0;
    };
    [[nodiscard]] Blocked blocked(const Sight& sight, const Eigen::Vector3f& normal) const;

    const SunLight& sun_;
    const FarLight& far_;
    std::vector<Moved> moved_;
    std::vector<Ball> balls_;  // of moved_
};

/// Returns the number of new samples that are as accurate as `count` old samples, if the share
/// `change` of the light may have changed after the old samples were traced. `change` is at least 0
/// and may exceed 1.
[[nodiscard]] float stillWorth(float count, float change);

}  // namespace mfar
