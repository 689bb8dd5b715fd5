#pragma once

#include "base/geometry.h"
#include "pipeline/scene/rigid_path.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// A picture that is mapped onto a surface and repeats in u and v. Row 0 is at v = 0, and texel
/// centres are at half-integers. Values are as in glTF: colours are sRGB, other data is linear.
struct SurfaceTexture {
    Size size;
    bool srgb = true;
    std::vector<std::array<std::uint8_t, 4>> texels;

    bool operator==(const SurfaceTexture&) const = default;
};

/// Metallic-roughness material of glTF 2.0. Factors are linear; `emission` is a radiance. A texture
/// is an index of Model::textures, or -1 without a texture. Its values are multiplied by the factor
/// of the same property.
struct Material {
    Eigen::Vector4f baseColour{1, 1, 1, 1};
    float metallic = 1, roughness = 1;
    Eigen::Vector3f emission{0, 0, 0};
    float normalScale = 1;
    /// The surface is cut out where the base colour's alpha is below this limit. 0: the surface is
    /// opaque.
    float alphaCutoff = 0;
    bool doubleSided = false;
    /// metallicRoughnessTexture has roughness in G and metallic in B.
    int baseColourTexture = -1, metallicRoughnessTexture = -1;
    int normalTexture = -1, emissionTexture = -1;

    [[nodiscard]] bool emits() const { return emission.maxCoeff() > 0; }
    bool operator==(const Material&) const = default;
};

/// Triangles with the same material. All vertex arrays have the same length, or are empty if the
/// attribute is absent.
struct Mesh {
    std::vector<Eigen::Vector3f> positions;  ///< [m], in the model's coordinates
    std::vector<Eigen::Vector3f> normals;    ///< unit length; empty: triangle normals are used
    std::vector<Eigen::Vector2f> uvs;
    std::vector<Eigen::Vector4f> tangents;  ///< xyz: unit tangent; w: bitangent's sign (+1, -1)
    std::vector<std::array<std::uint32_t, 3>> triangles;
    int material = 0;
    /// 0: the mesh does not move in the model. Otherwise it moves along Model::paths[part - 1], and
    /// its coordinates are relative to the path's last joint.
    int part = 0;

    bool operator==(const Mesh&) const = default;
};

/// An object in its own coordinates (z up, metres), with at least one material. It is valid: all
/// numbers are finite and all indices are in range.
struct Model {
    std::vector<Mesh> meshes;
    std::vector<RigidPath> paths;  ///< motion of the moving parts, see Mesh::part
    std::vector<Material> materials;
    std::vector<SurfaceTexture> textures;
    /// Sentences about parts of the model's file that are not shown: "file: place: fact".
    std::vector<std::string> notes;

    bool operator==(const Model&) const = default;
};

/// Distant light from all directions, as a latitude-longitude picture of linear RGB radiance, row
/// by row. Row 0 is up (world +z). Column 0 is world -x, and the column at three quarters of the
/// width is world +y.
struct Environment {
    Size size;
    std::vector<Eigen::Vector3f> radiance;

    bool operator==(const Environment&) const = default;
};

/// A distant light source that looks like a disc. `towards` is a unit vector in the world.
/// `irradiance` is the irradiance on a surface that faces the sun. `angularRadius` is in radians.
struct Sun {
    Eigen::Vector3f towards{0.40562F, -0.30421F, 0.86194F};
    Eigen::Vector3f irradiance{1, 1, 1};
    float angularRadius = 0.02F;

    bool operator==(const Sun&) const = default;
};

struct Lighting {
    std::shared_ptr<const Environment> environment;  ///< null: no light from the environment
    std::optional<Sun> sun;
};

/// A rigid part of a model, placed in the world. In rendered pictures, the object's number is its
/// index in Scene::objects + 1.
struct SceneObject {
    std::shared_ptr<const Model> model;
    RigidTransform T_world_object;
    float scale = 1;
    /// The plane z = 0 of this frame is the real surface on which the object stands.
    RigidTransform T_world_ground{};
    int part = 0;                             ///< only meshes of this part are shown
    std::shared_ptr<const RigidPath> path{};  ///< T_world_object over time; null: it does not move

    friend bool operator==(const SceneObject& a, const SceneObject& b) {
        return a.model == b.model && a.part == b.part && a.path == b.path && a.scale == b.scale &&
               a.T_world_object == b.T_world_object;
    }
};

/// The real surface that receives shadows and reflected light of the virtual objects, as diffuse
/// triangles in the world [m]. Only the change of its light is drawn, not the surface itself.
struct ShadowCatcher {
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Eigen::Vector3f albedo{0.6F, 0.6F, 0.6F};
};

struct Scene {
    std::vector<SceneObject> objects;  ///< at most 250
    Lighting lighting;
    ShadowCatcher catcher;
};

}  // namespace mfar
