#pragma once

#include "pipeline/scene/scene.h"

#include <functional>
#include <vector>

namespace mfar {

/// Radius and height [m] of points on the outline of a turned object, from bottom to top.
using LatheProfile = std::vector<Eigen::Vector2f>;

/// Returns a smooth curve through all knots (centripetal Catmull-Rom spline), sampled at `count`
/// points. The points are spread evenly over the segments between knots, regardless of their
/// lengths. Negative radii become 0. There must be at least two knots and two points.
[[nodiscard]] LatheProfile smoothProfile(const LatheProfile& knots, int count);

struct LatheOptions {
    int around = 96;  ///< number of segments around the axis
    /// Texture coordinate v at the profile's ends. u increases from 0 to 1 around the axis.
    float vBottom = 1, vTop = 0;
    Eigen::Vector2f centre{0, 0};  ///< x and y of the axis [m]
    /// Returns the factor by which the radius is multiplied at an angle [rad] and a height [m]. If
    /// the function is empty, the factor is 1.
    std::function<float(float angle, float height)> shape{};
};

/// Adds the surface that the profile describes when it turns about the vertical axis through
/// options.centre. The normals are smooth and point outwards.
void addTurned(Mesh& mesh, const LatheProfile& profile, const LatheOptions& options);

}  // namespace mfar
