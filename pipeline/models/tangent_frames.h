#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Adds tangents, which point in the direction of increasing u, to a mesh with texture coordinates.
/// The tangent of a vertex is the sum of the tangents of its triangles, made orthogonal to the
/// normal. If the texture coordinates give no direction, the tangent is any vector orthogonal to
/// the normal. As in glTF, the bitangent w * cross(normal, tangent) points up in the texture, where
/// v decreases. Source: Lengyel, Foundations of Game Engine Development 2, 2019, sec. 7.5.
void addTangents(Mesh& mesh);

[[nodiscard]] Eigen::Vector3f anyOrthogonal(const Eigen::Vector3f& unit);

}  // namespace mfar
