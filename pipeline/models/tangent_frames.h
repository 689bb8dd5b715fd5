#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Adds tangents (direction of growing u) to a mesh with texture coordinates: per vertex the sum
/// over its triangles, orthogonalised against the normal; any direction if the coordinates have
/// none. As in glTF, the bitangent, w normal x tangent, points up in the picture, where v
/// decreases.
/// Source: Lengyel, Foundations of Game Engine Development 2, 2019, sec. 7.5.
void addTangents(Mesh& mesh);

/// Any unit vector orthogonal to a unit vector.
[[nodiscard]] Eigen::Vector3f anyOrthogonal(const Eigen::Vector3f& unit);

}  // namespace mfar
