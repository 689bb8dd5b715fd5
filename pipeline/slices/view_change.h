#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace mfar {

/// Bounding ball of an object; world coordinates [m].
struct ObjectBall {
    Eigen::Vector3d centre;
    double radius;
};

/// One ball for each object that has vertices.
[[nodiscard]] std::vector<ObjectBall> objectBalls(const Scene& scene);

/// Up to these changes of the view a warped picture serves as well as a new one.
struct ViewLimits {
    /// Angle [degrees] by which the line from an object's centre to the camera turns, above 0.
    double turnDegrees = 4;
    double zoom = 0.2;  ///< relative change of the distance from camera to object, above 0
    bool operator==(const ViewLimits&) const = default;
};

/// How much two views of the objects differ, as a multiple of the limits. From 1 on, a picture of
/// the view `from` is too different to be warped to the view `to`. A rotation of the camera on the
/// spot counts only for objects that `from` does not show completely, because the warp can undo it.
/// Objects that are not visible in `to` do not count. Infinite if the cameras differ, or if an
/// object is visible in `to` but not in `from`.
[[nodiscard]] double viewChange(const RenderView& from, const RenderView& to,
                                std::span<const ObjectBall> objects, const ViewLimits& limits);

/// Largest motion of the objects from one view to the other [px], computed without lens distortion.
/// Points that are not in front of both cameras do not count. Infinite if the cameras differ.
[[nodiscard]] double pixelChange(const RenderView& from, const RenderView& to,
                                 std::span<const ObjectBall> objects);

/// Difference of two lightings relative to the stronger one. It is the largest difference of a
/// spherical harmonics coefficient of degree 0 or 1 (the mean radiance and its first moments over
/// all directions).
[[nodiscard]] double lightChange(const Lighting& a, const Lighting& b);

/// Whether the scenes have the same objects. Their light may differ.
[[nodiscard]] bool sameObjects(const Scene& a, const Scene& b);

/// Whether the camera's parameters are valid and the pose is finite with a valid rotation.
[[nodiscard]] bool isUsable(const RenderView& view);

}  // namespace mfar
