#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"

#include <optional>

namespace mfar {

/// A primitive of a mesh in glTF's frame. readPrimitive() adds normals if there are none, and
/// tangents if the material has a normal texture. Mesh::material stays 0. Points and lines give an
/// empty result. Refuses invalid data and more vertices or triangles than the limits allow.
struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    TextureMapping mapping;
    bool textured = false, bumpy = false;  ///< has any texture; a normal texture
    std::string place;
};
[[nodiscard]] std::optional<Mesh> readPrimitive(const GltfDocument& document,
                                                const PrimitiveSource& source);

/// The mesh after the transform of a node. A mirroring transform reverses the order of the
/// triangles' corners.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh);

}  // namespace mfar
