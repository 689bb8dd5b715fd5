#pragma once

#include "pipeline/models/gltf_document.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// The set of texture coordinates that a material's textures use, and the transform of these
/// coordinates (KHR_texture_transform): uv' = offset + R(rotation) (scale uv).
struct TextureMapping {
    int set = 0;  ///< the n of the attribute TEXCOORD_n
    Eigen::Vector2f offset{0, 0}, scale{1, 1};
    float rotation = 0;  ///< angle of R [rad]

    bool operator==(const TextureMapping&) const = default;
    [[nodiscard]] Eigen::Vector2f operator()(const Eigen::Vector2f& uv) const;
};

/// Materials of a document and their textures. Each is read when it is first needed. Values that
/// are out of range are refused.
class GltfMaterials {
public:
    explicit GltfMaterials(const GltfDocument& document) : document_(document) {}

    /// Returns the material that has index `material` in the document (-1: the default material):
    /// its number in this object, and its texture mapping. Reads it if this was not done before.
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
    std::map<std::pair<int, bool>, int> pictures_;  ///< key: index of the image, and whether it is
                                                    ///< sRGB; value: index in textures_
    std::vector<Material> materials_;
    std::vector<SurfaceTexture> textures_;
    std::optional<TextureMapping> mapping_;  ///< texture mapping of the material that is being read
    std::size_t texels_ = 0, bytes_ = 0;
};

}  // namespace mfar
