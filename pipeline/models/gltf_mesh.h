#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"

#include <optional>

namespace mfar {

/// A primitive of a glTF mesh, and what readPrimitive() needs to know about its material.
struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    TextureMapping mapping;
    /// textured: the material has a texture; bumpy: it has a normal texture.
    bool textured = false, bumpy = false;
    std::string place;
};
/// Returns the primitive in glTF's coordinates, with material 0. The mesh has tangents if the
/// material has a normal texture. Returns nothing for points, for lines, and without vertices.
/// Refuses invalid data, and more vertices or triangles than the limits allow.
[[nodiscard]] std::optional<Mesh> readPrimitive(const GltfDocument& document,
                                                const PrimitiveSource& source);

/// Returns the mesh, transformed by `T_model_mesh`. If the transform mirrors, the corners of each
/// triangle are reordered, so that its front stays the front.
[[nodiscard]] Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh);

}  // namespace mfar
