#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace mfar {

/// A ball around an object, in the world [m].
struct ObjectBall {
    Eigen::Vector3d centre;
    double radius;
};

/// One for each of the scene's objects that has vertices.
[[nodiscard]] std::vector<ObjectBall> objectBalls(const Scene& scene);

/// Up to where a picture of another view serves, warped, as well as a new one.
struct ViewLimits {
    double turnDegrees = 4;  ///< of the line of sight about an object's centre, above 0
    double zoom = 0.2;       ///< change of the distance to it as a share, above 0
    bool operator==(const ViewLimits&) const = default;
};

/// How differently two views show the objects, in units of the limits: from 1 on too differently.
/// The camera's turning on the spot changes nothing that a warp cannot make up for, and counts, as
/// an angle across the picture, for objects alone that `from` does not show as a whole. Objects
/// that `to` does not show count for nothing. Infinity for cameras that are not the same, and for
/// an object that `to` shows and `from` does not.
[[nodiscard]] double viewChange(const RenderView& from, const RenderView& to,
                                std::span<const ObjectBall> objects, const ViewLimits& limits);

/// By how much the objects move from one view to the other, at most, seen without distortion [px].
/// Those that either does not have before it count for nothing. Infinity for cameras that are not
/// the same.
[[nodiscard]] double pixelChange(const RenderView& from, const RenderView& to,
                                 std::span<const ObjectBall> objects);

/// How much the light differs, as a share of the stronger: the largest difference of the mean
/// radiance and of its first moment over all directions (spherical harmonics of degree 0 and 1).
[[nodiscard]] double lightChange(const Lighting& a, const Lighting& b);

/// Whether all but the light is the same.
[[nodiscard]] bool sameObjects(const Scene& a, const Scene& b);

/// Whether a camera can be there: its numbers sound, its pose finite and a rotation.
[[nodiscard]] bool isUsable(const RenderView& view);

}  // namespace mfar
