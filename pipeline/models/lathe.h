#pragma once

#include "pipeline/scene/scene.h"

#include <functional>
#include <vector>

namespace mfar {

/// Radius and height [m] along a turned object, from bottom to top as seen from outside.
using LatheProfile = std::vector<Eigen::Vector2f>;

/// `count` points of a smooth curve through all knots (centripetal Catmull-Rom), spaced evenly in
/// knot numbers. At least two knots and two points.
[[nodiscard]] LatheProfile smoothProfile(const LatheProfile& knots, int count);

/// Placement and sampling of a turned profile.
struct LatheOptions {
    int around = 96;              ///< segments
    float vBottom = 1, vTop = 0;  ///< texture coordinate at the profile's ends; u goes once around
    Eigen::Vector2f centre{0, 0};
    /// Factor of the radius at an angle [rad] and height [m]; empty: 1.
    std::function<float(float angle, float height)> shape{};
};

/// Adds the surface of a profile rotated about the z axis, with smooth normals that face outwards.
void addTurned(Mesh& mesh, const LatheProfile& profile, const LatheOptions& options);

}  // namespace mfar
