#pragma once

#include "pipeline/models/gltf_document.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Number of the texture coordinates that a material's textures use, and their transform
/// (KHR_texture_transform): uv' = offset + R(rotation) (scale uv).
struct TextureMapping {
    int set = 0;  ///< n of TEXCOORD_n
    Eigen::Vector2f offset{0, 0}, scale{1, 1};
    float rotation = 0;  ///< [rad]

    bool operator==(const TextureMapping&) const = default;
    [[nodiscard]] Eigen::Vector2f operator()(const Eigen::Vector2f& uv) const;
};

/// Materials of a document and their textures. Each is decoded when it is first needed. Refuses
/// values out of range.
class GltfMaterials {
public:
    explicit GltfMaterials(const GltfDocument& document) : document_(document) {}

    /// Reads a glTF material (-1: the default material). Returns its number in this object and its
    /// texture mapping.
    std::pair<int, TextureMapping> use(int material);

    [[nodiscard]] const Material& operator[](int number) const { return materials_[number]; }
    [[nodiscard]] std::vector<Material> takeMaterials() { return std::move(materials_); }
    [[nodiscard]] std::vector<SurfaceTexture> takeTextures() { return std::move(textures_); }

private:
    Material read(const tinygltf::Material& from, const std::string& place);
    int texture(const tinygltf::TextureInfo& info, bool srgb, const std::string& place);
    int picture(int image, bool srgb, const std::string& place);
    SurfaceTexture decode(const tinygltf::Image& image, const std::string& place);
    void takeMapping(const TextureMapping& wanted, const std::string& place);

    const GltfDocument& document_;
    std::map<int, std::pair<int, TextureMapping>> used_;
    std::map<std::pair<int, bool>, int> pictures_;  ///< key: image number, and whether it is sRGB
    std::vector<Material> materials_;
    std::vector<SurfaceTexture> textures_;
    std::optional<TextureMapping> mapping_;  ///< mapping of the material that is being read
    std::size_t texels_ = 0, bytes_ = 0;
};

}  // namespace mfar
