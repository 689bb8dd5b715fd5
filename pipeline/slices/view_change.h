#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace mfar {

/// Bounding ball of an object, in the world [m].
struct ObjectBall {
    Eigen::Vector3d centre;
    double radius;
};

/// One for each of the scene's objects that has vertices.
[[nodiscard]] std::vector<ObjectBall> objectBalls(const Scene& scene);

/// Limits of a view change up to which a warped picture serves as well as a new one.
struct ViewLimits {
    double turnDegrees = 4;  ///< turn of the line of sight about an object's centre, above 0
    double zoom = 0.2;       ///< change of the distance to it as a share, above 0
    bool operator==(const ViewLimits&) const = default;
};

/// How differently two views show the objects, in units of the limits: from 1 on too differently. A
/// warp can undo the camera's rotation on the spot, so its angle counts only for objects that
/// `from` does not show whole. Objects that `to` does not show do not count. Infinity for different
/// cameras, and for an object that `to` shows and `from` does not.
[[nodiscard]] double viewChange(const RenderView& from, const RenderView& to,
                                std::span<const ObjectBall> objects, const ViewLimits& limits);

/// Largest motion of the objects from one view to the other, without distortion [px]. Points that
/// are not in front of both cameras do not count. Infinity for different cameras.
[[nodiscard]] double pixelChange(const RenderView& from, const RenderView& to,
                                 std::span<const ObjectBall> objects);

/// Difference of the light as a share of the stronger: the largest difference of the mean radiance
/// and of its first moment over all directions (spherical harmonics of degree 0 and 1).
[[nodiscard]] double lightChange(const Lighting& a, const Lighting& b);

/// Whether the scenes differ in their light alone.
[[nodiscard]] bool sameObjects(const Scene& a, const Scene& b);

/// Whether the view is valid: camera parameters sound, pose finite and its rotation valid.
[[nodiscard]] bool isUsable(const RenderView& view);

}  // namespace mfar
