#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"

#include <optional>

namespace mfar {

/// One primitive of a mesh in glTF's own frame, with normals, and with tangents if its material has
/// a normal texture. Mesh::material is left at 0. Empty for points and lines. Refuses invalid data
/// and more than the given numbers of vertices or triangles.
struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    TextureMapping mapping;
    bool textured = false, bumpy = false;  ///< the material has any texture, a normal texture
    std::string place;
};
[[nodiscard]] std::optional<Mesh> readPrimitive(const GltfDocument& document,
                                                const PrimitiveSource& source);

/// The mesh transformed by a node. A mirroring transform reverses its triangles.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh);

}  // namespace mfar
