#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"

#include <optional>

namespace mfar {

/// A primitive of a glTF mesh, as the input of readPrimitive(). The result is in glTF's
/// coordinates, without a material (Mesh::material is 0). It has tangents if the material has a
/// normal texture. It is empty for points and lines. Invalid data, and more vertices or triangles
/// than the limits allow, are refused.
struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    TextureMapping mapping;
    bool textured = false, bumpy = false;  ///< whether the material has any texture; whether it has
                                           ///< a normal texture
    std::string place;
};
[[nodiscard]] std::optional<Mesh> readPrimitive(const GltfDocument& document,
                                                const PrimitiveSource& source);

/// Returns the mesh, transformed by `T_model_mesh`. If the transform mirrors, the order of the
/// triangles' corners is reversed.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh);

}  // namespace mfar
