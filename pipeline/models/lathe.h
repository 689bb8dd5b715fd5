#pragma once

#include "pipeline/scene/scene.h"

#include <functional>
#include <vector>

namespace mfar {

/// Radius and height [m] of the points along a turned object's outline, from bottom to top.
using LatheProfile = std::vector<Eigen::Vector2f>;

/// A smooth curve through all knots (centripetal Catmull-Rom spline), sampled at `count` points
/// that are evenly spaced in the knots' numbers. Needs at least two knots and two points.
[[nodiscard]] LatheProfile smoothProfile(const LatheProfile& knots, int count);

/// How a profile is placed and sampled.
struct LatheOptions {
    int around = 96;              ///< number of segments around the axis
    float vBottom = 1, vTop = 0;  ///< v at the profile's ends; u goes once around the axis
    Eigen::Vector2f centre{0, 0};
    /// Factor of the radius at an angle [rad] and a height [m]. If empty, the factor is 1.
    std::function<float(float angle, float height)> shape{};
};

/// Adds the surface that results from rotating a profile about the z axis. It has smooth normals
/// that face outwards.
void addTurned(Mesh& mesh, const LatheProfile& profile, const LatheOptions& options);

}  // namespace mfar
