#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Gives a mesh with texture coordinates the tangents along which u grows: per vertex the sum over
/// its triangles, made orthogonal to the normal; some direction where the coordinates have none. As
/// in glTF the bitangent, w normal x tangent, points up in the picture, where v decreases.
/// Source: Lengyel, Foundations of Game Engine Development 2, 2019, sec. 7.5.
void addTangents(Mesh& mesh);

/// Some unit vector orthogonal to a unit vector.
[[nodiscard]] Eigen::Vector3f anyOrthogonal(const Eigen::Vector3f& unit);

}  // namespace mfar
