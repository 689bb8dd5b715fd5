#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// A picture mapped onto a surface. Row 0 is v = 0, texel centres at half-integers; it repeats in u
/// and v. Values as in glTF: colours are sRGB, data linear.
struct SurfaceTexture {
    Size size;  ///< at least 1x1
    bool srgb = true;
    std::vector<std::array<std::uint8_t, 4>> texels;  ///< RGBA, row-major
};

/// Metallic-roughness material of glTF 2.0. Factors are linear. A texture index refers to
/// Model::textures, whose values multiply the factor; -1: no texture.
struct Material {
    Eigen::Vector4f baseColour{1, 1, 1, 1};
    float metallic = 1, roughness = 1;  ///< [0, 1]
    Eigen::Vector3f emission{0, 0, 0};  ///< radiance, finite, not negative
    float normalScale = 1;
    /// The surface has a hole where the base colour's alpha is below this limit; 0: opaque.
    float alphaCutoff = 0;
    bool doubleSided = false;
    int baseColourTexture = -1, metallicRoughnessTexture = -1;  ///< the latter: G rough, B metallic
    int normalTexture = -1, emissionTexture = -1;
};

/// Triangles of one material. All vertex arrays have the same length or are empty (absent).
struct Mesh {
    std::vector<Eigen::Vector3f> positions;  ///< [m], in the model's frame
    std::vector<Eigen::Vector3f> normals;    ///< unit length; empty: the triangles' normals
    std::vector<Eigen::Vector2f> uvs;
    std::vector<Eigen::Vector4f> tangents;  ///< xyz unit length, w = +-1: the bitangent's sign
    std::vector<std::array<std::uint32_t, 3>> triangles;
    int material = 0;
};

/// An object at rest in its own frame: z up, metres, nodes' transforms applied. Validated: all
/// numbers finite, all indices in range.
struct Model {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  ///< at least one
    std::vector<SurfaceTexture> textures;
};

/// Distant light from all directions. Latitude-longitude: row 0 is up (world +z), column 0 is world
/// -x, longitude grows towards +y at three quarters of the width. Linear RGB radiance.
struct Environment {
    Size size;
    std::vector<Eigen::Vector3f> radiance;  ///< row-major, finite, not negative
};

/// A distant disc of light.
struct Sun {
    /// World direction to the sun, unit length.
    Eigen::Vector3f towards{0.40562F, -0.30421F, 0.86194F};
    Eigen::Vector3f irradiance{1, 1, 1};  ///< on a surface that faces the sun
    float angularRadius = 0.02F;          ///< [rad], above 0
};

struct Lighting {
    std::shared_ptr<const Environment> environment;  ///< may be null: dark
    std::optional<Sun> sun;
};

/// A model in the world. Its number in rendered pictures is its index in Scene::objects + 1.
struct SceneObject {
    std::shared_ptr<const Model> model;
    RigidTransform T_world_object;
    float scale = 1;  ///< above 0

    /// True for the same model with an identical placement.
    friend bool operator==(const SceneObject& a, const SceneObject& b) {
        return a.model == b.model && a.scale == b.scale &&
               a.T_world_object.rotation == b.T_world_object.rotation &&
               a.T_world_object.translation == b.T_world_object.translation;
    }
};

/// The real surface that receives shadows and bounced light: triangles in the world, diffuse.
/// Invisible itself: only the objects' change of its light is shown.
struct ShadowCatcher {
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Eigen::Vector3f albedo{0.6F, 0.6F, 0.6F};
};

struct Scene {
    std::vector<SceneObject> objects;  ///< at most 250
    Lighting lighting;
    ShadowCatcher catcher;  ///< may be empty
};

}  // namespace mfar
