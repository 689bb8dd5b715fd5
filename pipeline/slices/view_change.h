#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene_bounds.h"

#include <span>

namespace mfar {

/// Largest changes of the view up to which a warped picture is as good as a new one.
struct ViewLimits {
    /// Angle between the lines from an object's centre to the two camera positions [degrees], above
    /// 0.
    double turnDegrees = 4;
    double zoom = 0.2;  ///< relative change of the distance from camera to object, above 0
    bool operator==(const ViewLimits&) const = default;
};

/// Returns the difference of two views as a multiple of the limits. If the result is 1 or more, a
/// new picture is better than a picture of the view `from` that is warped to the view `to`. The
/// warp can undo a pure rotation of the camera. Therefore a rotation counts only for objects that
/// `from` shows incompletely. Objects that are not visible in `to` do not count. Infinite if the
/// cameras differ, or if an object is visible only in `to`.
[[nodiscard]] double viewChange(const RenderView& from, const RenderView& to,
                                std::span<const ObjectBall> objects, const ViewLimits& limits);

/// True if a ball may be at least partly in the picture.
[[nodiscard]] bool isSeen(std::span<const ObjectBall> balls, const RenderView& view);

/// Largest motion of the objects between two views [px], without lens distortion. It is measured at
/// the centre of each ball and at six points of its surface. Only points in front of both cameras
/// count. Infinite if the cameras differ.
[[nodiscard]] double pixelChange(const RenderView& from, const RenderView& to,
                                 std::span<const ObjectBall> objects);

/// Difference of two lightings relative to the stronger one. It is the largest difference of a
/// spherical harmonics coefficient of degree 0 or 1 (mean radiance and first moments).
[[nodiscard]] double lightChange(const Lighting& a, const Lighting& b);

/// True if objects and shadow catcher are equal. Their light may differ.
[[nodiscard]] bool sameObjects(const Scene& a, const Scene& b);

/// True if the camera's parameters are valid and the pose is finite with a valid rotation.
[[nodiscard]] bool isUsable(const RenderView& view);

}  // namespace mfar
