#include "pipeline/render/scene_check.h"

#include "base/se3.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

constexpr float kUnitTolerance = 1e-3F;
constexpr float kQuarterTurn = 1.57079632679F;

void require(bool sound, const std::string& what) {
    if (!sound) throw std::invalid_argument("scene: " + what);
}

template <typename Vector>
bool allFinite(const std::vector<Vector>& values) {
    return std::ranges::all_of(values, [](const Vector& v) { return v.allFinite(); });
}

bool isRadiance(const Eigen::Vector3f& rgb) {
    return rgb.allFinite() && rgb.minCoeff() >= 0;
}

bool isShare(float x) {
    return x >= 0 && x <= 1;
}

void requireIndices(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t count,
                    const char* what) {
    for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
            require(corner < count,
                    std::string(what) + " has a triangle with a vertex that does not exist");
}

void checkMesh(const Mesh& mesh, std::size_t materials) {
    const std::size_t n = mesh.positions.size();
    const auto fits = [n](std::size_t length) { return length == 0 || length == n; };
    require(allFinite(mesh.positions), "a vertex position of a mesh is not finite");
    require(allFinite(mesh.normals) && allFinite(mesh.tangents) && allFinite(mesh.uvs),
            "a normal, tangent or texture coordinate of a mesh is not finite");
    require(fits(mesh.normals.size()) && fits(mesh.uvs.size()) && fits(mesh.tangents.size()),
            "a mesh has normals, tangents or texture coordinates, but not one per vertex");
    require(mesh.material >= 0 && static_cast<std::size_t>(mesh.material) < materials,
            "a mesh names a material that the model does not have");
    requireIndices(mesh.triangles, n, "a mesh");
}

void checkMaterial(const Material& m, std::size_t textures) {
    require(m.baseColour.allFinite() && m.baseColour.minCoeff() >= 0,
            "a material's colour is negative or not finite");
    require(isShare(m.metallic) && isShare(m.roughness),
            "a material's metallic or roughness is not in [0, 1]");
    require(isRadiance(m.emission), "a material's emission is negative or not finite");
    require(std::isfinite(m.normalScale) && std::isfinite(m.alphaCutoff),
            "a material's normal scale or alpha cut-off is not finite");
    for (const int index :
         {m.baseColourTexture, m.metallicRoughnessTexture, m.normalTexture, m.emissionTexture})
        require(index >= -1 && index < static_cast<int>(textures),
                "a material names a texture that the model does not have");
}

void checkModel(const Model& model) {
    require(!model.materials.empty(), "a model has no material");
    for (const Mesh& mesh : model.meshes)
        checkMesh(mesh, model.materials.size());
    for (const Material& material : model.materials)
        checkMaterial(material, model.textures.size());
    for (const SurfaceTexture& t : model.textures)
        require(t.size.width >= 1 && t.size.height >= 1 &&
                    t.texels.size() == static_cast<std::size_t>(t.size.width) *
                                           static_cast<std::size_t>(t.size.height),
                "a texture's number of texels is not its width times its height");
}

void checkLighting(const Lighting& lighting) {
    if (lighting.environment) {
        const Environment& e = *lighting.environment;
        require(e.size.width >= 1 && e.size.height >= 1 &&
                    e.radiance.size() == static_cast<std::size_t>(e.size.width) *
                                             static_cast<std::size_t>(e.size.height),
                "the environment's number of texels is not its width times its height");
        require(std::ranges::all_of(e.radiance, isRadiance),
                "a radiance of the environment is negative or not finite");
    }
    if (!lighting.sun) return;
    const Sun& sun = *lighting.sun;
    require(std::abs(sun.towards.norm() - 1) < kUnitTolerance,
            "the sun's direction does not have length 1");
    require(isRadiance(sun.irradiance), "the sun's irradiance is negative or not finite");
    require(sun.angularRadius > 0 && sun.angularRadius < kQuarterTurn,
            "the sun's angular radius is not between 0 and pi/2 rad");
}

}  // namespace

void validate(const Scene& scene) {
    require(scene.objects.size() <= kMostSceneObjects, "the scene has more than 250 objects");
    for (const SceneObject& object : scene.objects) {
        require(object.model != nullptr, "an object has no model");
        require(isFinite(object.T_world_object), "an object's pose is not finite");
        require(std::isfinite(object.scale) && object.scale > 0,
                "an object's scale is not finite or not above 0");
        checkModel(*object.model);
    }
    checkLighting(scene.lighting);
    require(allFinite(scene.catcher.positions), "a vertex of the shadow catcher is not finite");
    require(isRadiance(scene.catcher.albedo) && scene.catcher.albedo.maxCoeff() <= 1,
            "the shadow catcher's albedo is not in [0, 1]");
    requireIndices(scene.catcher.triangles, scene.catcher.positions.size(), "the shadow catcher");
}

}  // namespace mfar
