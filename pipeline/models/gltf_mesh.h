#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"

#include <optional>

namespace mfar {

/// A primitive of a glTF mesh. readPrimitive() returns it in glTF's coordinates, with material 0.
/// It has tangents if the material has a normal texture. The result is empty for points and lines.
/// Invalid data, and more vertices or triangles than the limits allow, are refused.
struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    TextureMapping mapping;
    bool textured = false, bumpy = false;  ///< bumpy: the material has a normal texture
    std::string place;
};
[[nodiscard]] std::optional<Mesh> readPrimitive(const GltfDocument& document,
                                                const PrimitiveSource& source);

/// Returns the mesh, transformed by `T_model_mesh`. If the transform mirrors, the corners of each
/// triangle are reordered, so that its front stays the front.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh);

}  // namespace mfar
