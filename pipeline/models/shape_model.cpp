#include "pipeline/models/shape_model.h"

#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kRoughness = 0.5F;

std::uint8_t displayByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255));
}

/// Returns the checkerboard texture of one side of the object. A square is 4 to 32 texels wide, so
/// that its edges are sharp.
SurfaceTexture checkerboard(const VirtualObject& object) {
    constexpr int kMostTexels = 1024, kMostASquare = 32, kLeastASquare = 4;
    const int each = std::clamp(kMostTexels / object.squares, kLeastASquare, kMostASquare);
    SurfaceTexture out{{object.squares * each, object.squares * each}, true, {}};
    for (int y = 0; y < out.size.height; ++y) {
        for (int x = 0; x < out.size.width; ++x) {
            const Eigen::Vector3f& c = object.colours[(x / each + y / each) % 2];
            out.texels.push_back({displayByte(c.x()), displayByte(c.y()), displayByte(c.z()), 255});
        }
    }
    return out;
}

Material materialOf(const VirtualObject& object) {
    Material material;
    material.metallic = 0;
    material.roughness = kRoughness;
    material.doubleSided = object.shape == VirtualShape::Quad;
    if (object.colours[0] != object.colours[1]) {
        material.baseColourTexture = 0;
        return material;
    }
    for (int i = 0; i < 3; ++i)
        material.baseColour[i] = linearOfSrgbByte()[displayByte(object.colours[0][i])];
    return material;
}

}  // namespace

Model shapeModel(const VirtualObject& object) {
    Model model;
    model.materials = {materialOf(object)};
    const bool plain = model.materials[0].baseColourTexture < 0;
    if (!plain) model.textures = {checkerboard(object)};
    const ShapeMesh shape = shapeMesh(object.shape);
    const Eigen::Vector3f size = object.size.cast<float>();
    Mesh& mesh = model.meshes.emplace_back();
    mesh.triangles = shape.triangles;
    // Textures repeat, so interpolation at a border of the texture mixes in the opposite border. To
    // avoid this, texture coordinates go only from the centre of the first texel to the centre of
    // the last texel.
    const float texels = plain ? 1 : static_cast<float>(model.textures[0].size.width);
    for (const ShapeMesh::Vertex& v : shape.vertices) {
        mesh.positions.push_back(v.position.cwiseProduct(size));
        mesh.normals.push_back(v.normal.cwiseQuotient(size).normalized());
        if (!plain)
            mesh.uvs.push_back(Eigen::Vector2f::Constant(0.5F / texels) +
                               v.uv * ((texels - 1) / texels));
    }
    return model;
}

}  // namespace mfar
