#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Adds tangents (the direction in which u grows) to a mesh with texture coordinates. The tangent
/// of a vertex is the sum over the vertex's triangles, made orthogonal to the normal. If the
/// texture coordinates give no direction, any direction is used. As in glTF, the bitangent w *
/// (normal x tangent) points up in the picture, where v decreases. Source: Lengyel, Foundations of
/// Game Engine Development 2, 2019, sec. 7.5.
void addTangents(Mesh& mesh);

/// A unit vector that is orthogonal to the given unit vector.
[[nodiscard]] Eigen::Vector3f anyOrthogonal(const Eigen::Vector3f& unit);

}  // namespace mfar
