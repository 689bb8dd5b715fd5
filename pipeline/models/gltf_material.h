#pragma once

#include "pipeline/models/gltf_document.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// The set of texture coordinates that a material's textures use, and their transform
/// (KHR_texture_transform): uv' = offset + R(rotation) (scale uv).
struct TextureMapping {
    int set = 0;  ///< the n of the attribute TEXCOORD_n
    Eigen::Vector2f offset{0, 0}, scale{1, 1};
    float rotation = 0;  ///< angle of R [rad]

    bool operator==(const TextureMapping&) const = default;
    [[nodiscard]] Eigen::Vector2f operator()(const Eigen::Vector2f& uv) const;
};

/// Materials of a document and their textures, read when they are first needed. Values that are out
/// of range are refused.
class GltfMaterials {
public:
    explicit GltfMaterials(const GltfDocument& document) : document_(document) {}

    /// `material` is an index in the document, or -1 for the default material. Returns the
    /// material's number in this object, and its texture mapping.
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
    /// Key: index of the image, and true for sRGB. Value: index in textures_.
    std::map<std::pair<int, bool>, int> pictures_;
    std::vector<Material> materials_;
    std::vector<SurfaceTexture> textures_;
    std::optional<TextureMapping> mapping_;
    std::size_t texels_ = 0, bytes_ = 0;
};

}  // namespace mfar
