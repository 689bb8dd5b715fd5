#pragma once

#include "pipeline/scene/scene.h"

#include <functional>
#include <vector>

namespace mfar {

/// The outline of a turned object: radius and height [m] of points along it, from bottom to top.
using LatheProfile = std::vector<Eigen::Vector2f>;

/// Returns a smooth curve through all knots (centripetal Catmull-Rom spline), sampled at `count`
/// points. The segments between two knots get equal numbers of points. There must be at least two
/// knots and two points.
[[nodiscard]] LatheProfile smoothProfile(const LatheProfile& knots, int count);

/// How a profile is turned into a surface.
struct LatheOptions {
    int around = 96;              ///< number of segments around the axis
    float vBottom = 1, vTop = 0;  ///< texture coordinate v at the profile's ends; u increases from
                                  ///< 0 to 1 around the axis
    Eigen::Vector2f centre{0, 0};
    /// Returns the factor by which the radius is multiplied at an angle [rad] and a height [m]. If
    /// empty, the factor is 1.
    std::function<float(float angle, float height)> shape{};
};

/// Adds the surface that results from rotating a profile about the vertical axis through
/// options.centre. The surface has smooth normals that face outwards.
void addTurned(Mesh& mesh, const LatheProfile& profile, const LatheOptions& options);

}  // namespace mfar
