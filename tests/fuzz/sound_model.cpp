#include "tests/fuzz/sound_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mfar::test {
namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(what);
}

bool isUnit(const Eigen::Vector3f& v) {
    return std::abs(v.norm() - 1) < 1e-3F;
}

bool isOne(float v) {
    return v >= 0 && v <= 1;
}

void requireSound(const Material& m, const Model& model) {
    require(std::all_of(m.baseColour.begin(), m.baseColour.end(), isOne),
            "a base colour is outside of [0, 1]");
    require(isOne(m.metallic) && isOne(m.roughness), "metallic or roughness is outside of [0, 1]");
    require(m.alphaCutoff >= 0 && std::isfinite(m.alphaCutoff),
            "an alpha cutoff is negative or not finite");
    require(m.emission.allFinite() && m.emission.minCoeff() >= 0,
            "an emission is negative or not finite");
    require(std::isfinite(m.normalScale), "a normal scale is not finite");
    const int textures = static_cast<int>(model.textures.size());
    for (const int t :
         {m.baseColourTexture, m.metallicRoughnessTexture, m.normalTexture, m.emissionTexture})
        require(t >= -1 && t < textures, "a material refers to a texture that does not exist");
}

void requireSound(const Mesh& mesh, const Model& model) {
    const std::size_t count = mesh.positions.size();
    for (const std::size_t n : {mesh.normals.size(), mesh.uvs.size(), mesh.tangents.size()})
        require(n == 0 || n == count, "the vertex arrays of a mesh have different lengths");
    for (const Eigen::Vector3f& p : mesh.positions)
        require(p.allFinite(), "a vertex position is not finite");
    for (const Eigen::Vector3f& n : mesh.normals)
        require(isUnit(n), "a normal does not have the length 1");
    for (const Eigen::Vector2f& uv : mesh.uvs)
        require(uv.allFinite(), "texture coordinates are not finite");
    for (const Eigen::Vector4f& t : mesh.tangents)
        require(isUnit(t.head<3>()) && std::abs(t.w()) == 1,
                "a tangent does not have the length 1, or has no sign");
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t i : triangle)
            require(i < count, "a triangle refers to a vertex that does not exist");
    require(mesh.material >= 0 && static_cast<std::size_t>(mesh.material) < model.materials.size(),
            "a mesh refers to a material that does not exist");
}

}  // namespace

void requireSoundModel(const Model& model) {
    require(!model.materials.empty(), "an accepted model has no material");
    for (const Mesh& mesh : model.meshes)
        requireSound(mesh, model);
    for (const Material& material : model.materials)
        requireSound(material, model);
    for (const SurfaceTexture& t : model.textures)
        require(t.size.width >= 1 && t.size.height >= 1 &&
                    t.texels.size() == static_cast<std::size_t>(t.size.width) * t.size.height,
                "the number of texels does not match the texture's size");
}

}  // namespace mfar::test
