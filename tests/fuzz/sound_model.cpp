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
    require(std::all_of(m.baseColour.begin(), m.baseColour.end(), isOne), "base colour");
    require(isOne(m.metallic) && isOne(m.roughness) && isOne(m.alphaCutoff), "factors");
    require(m.emission.allFinite() && m.emission.minCoeff() >= 0, "emission");
    require(std::isfinite(m.normalScale), "normal scale");
    const int textures = static_cast<int>(model.textures.size());
    for (const int t :
         {m.baseColourTexture, m.metallicRoughnessTexture, m.normalTexture, m.emissionTexture})
        require(t >= -1 && t < textures, "texture index");
}

void requireSound(const Mesh& mesh, const Model& model) {
    const std::size_t count = mesh.positions.size();
    for (const std::size_t n : {mesh.normals.size(), mesh.uvs.size(), mesh.tangents.size()})
        require(n == 0 || n == count, "lengths of vertex arrays");
    for (const Eigen::Vector3f& p : mesh.positions)
        require(p.allFinite(), "position");
    for (const Eigen::Vector3f& n : mesh.normals)
        require(isUnit(n), "normal");
    for (const Eigen::Vector2f& uv : mesh.uvs)
        require(uv.allFinite(), "texture coordinates");
    for (const Eigen::Vector4f& t : mesh.tangents)
        require(isUnit(t.head<3>()) && std::abs(t.w()) == 1, "tangent");
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t i : triangle)
            require(i < count, "vertex index");
    require(mesh.material >= 0 && static_cast<std::size_t>(mesh.material) < model.materials.size(),
            "material index");
}

}  // namespace

void requireSoundModel(const Model& model) {
    require(!model.materials.empty(), "no material");
    for (const Mesh& mesh : model.meshes)
        requireSound(mesh, model);
    for (const Material& material : model.materials)
        requireSound(material, model);
    for (const SurfaceTexture& t : model.textures)
        require(t.size.width >= 1 && t.size.height >= 1 &&
                    t.texels.size() == static_cast<std::size_t>(t.size.width) * t.size.height,
                "texels");
}

}  // namespace mfar::test
