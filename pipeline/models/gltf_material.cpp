#include "pipeline/models/gltf_material.h"

#include "base/bounded_file.h"
#include "hal/image_codec.h"
#include "pipeline/models/named_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

/// Returns `value`, limited to the range [least, most] that glTF allows. A small excess counts as a
/// rounding error of the program that wrote the file. A larger excess is refused.
float rangedFactor(const GltfDocument& document, double value, float least, float most,
                   const std::string& place) {
    constexpr double kRounding = 1e-3;
    if (!(value >= least - kRounding && value <= most + kRounding))
        document.refuse(place, fmt::format("must be from {} to {}, not {}", least, most, value));
    return std::clamp(static_cast<float>(value), least, most);
}

std::optional<double> numberIn(const tinygltf::Value& object, const std::string& key) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return std::nullopt;
    return object.Get(key).GetNumberAsDouble();
}

float mappingNumber(const GltfDocument& document, const tinygltf::Value& value,
                    const std::string& place) {
    constexpr float kFarthestUv = 1e4F;
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
    return rangedFactor(document, number, -kFarthestUv, kFarthestUv, place);
}

void readPair(const GltfDocument& document, const tinygltf::Value& object, const char* key,
              Eigen::Vector2f& out, const std::string& place) {
    if (!object.Has(key)) return;
    const tinygltf::Value& list = object.Get(key);
    if (!list.IsArray() || list.ArrayLen() != 2)
        document.refuse(place, fmt::format("{} must be a pair of numbers", key));
    out = {mappingNumber(document, list.Get(0), place),
           mappingNumber(document, list.Get(1), place)};
}

TextureMapping mappingOf(const GltfDocument& document, const tinygltf::TextureInfo& info,
                         const std::string& place) {
    TextureMapping mapping;
    mapping.set = info.texCoord;
    const auto it = info.extensions.find("KHR_texture_transform");
    if (it == info.extensions.end() || !it->second.IsObject()) return mapping;
    readPair(document, it->second, "offset", mapping.offset, place);
    readPair(document, it->second, "scale", mapping.scale, place);
    if (it->second.Has("rotation"))
        mapping.rotation = mappingNumber(document, it->second.Get("rotation"), place);
    if (const auto set = numberIn(it->second, "texCoord"))
        mapping.set = static_cast<int>(rangedFactor(document, *set, 0, 15, place));
    return mapping;
}

float alphaCutoffOf(const GltfDocument& document, const tinygltf::Material& from,
                    const std::string& place) {
    constexpr float kCutoffOfBlend = 0.5F;
    if (from.alphaMode == "OPAQUE") return 0;
    if (from.alphaMode == "BLEND") return kCutoffOfBlend;
    if (from.alphaMode != "MASK")
        document.refuse(
            place + ".alphaMode",
            fmt::format("{} is not supported; expected OPAQUE, MASK or BLEND", from.alphaMode));
    if (!(from.alphaCutoff >= 0))
        document.refuse(place + ".alphaCutoff",
                        fmt::format("must be at least 0, not {}", from.alphaCutoff));
    // Every cutoff above 1 cuts away the whole surface.
    return static_cast<float>(std::min(from.alphaCutoff, 2.0));
}

Eigen::Vector3f emissionOf(const GltfDocument& document, const tinygltf::Material& from,
                           const std::string& place) {
    constexpr float kStrongest = 1e6F;
    Eigen::Vector3f emission;
    for (int i = 0; i < 3; ++i)
        emission[i] =
            rangedFactor(document, from.emissiveFactor[i], 0, 1, place + ".emissiveFactor");
    const auto it = from.extensions.find("KHR_materials_emissive_strength");
    if (it == from.extensions.end()) return emission;
    const double strength = numberIn(it->second, "emissiveStrength").value_or(1);
    return emission * rangedFactor(document, strength, 0, kStrongest, place + ".emissiveStrength");
}

tinygltf::TextureInfo plainInfo(const tinygltf::NormalTextureInfo& info) {
    tinygltf::TextureInfo out;
    out.index = info.index;
    out.texCoord = info.texCoord;
    out.extensions = info.extensions;
    return out;
}

}  // namespace

// Rotates in the same direction as the specification's example and three.js. The GLSL code in the
// first drafts of the specification rotated in the opposite direction.
Eigen::Vector2f TextureMapping::operator()(const Eigen::Vector2f& uv) const {
    const Eigen::Vector2f scaled = scale.cwiseProduct(uv);
    const float c = std::cos(rotation), s = std::sin(rotation);
    return offset +
           Eigen::Vector2f(c * scaled.x() + s * scaled.y(), -s * scaled.x() + c * scaled.y());
}

std::pair<int, TextureMapping> GltfMaterials::use(int material) {
    if (const auto it = used_.find(material); it != used_.end()) return it->second;
    mapping_.reset();
    const std::string place = fmt::format("materials[{}]", material);
    materials_.push_back(
        material < 0
            ? Material{}
            : read(document_.at(document_.gltf.materials, material, "primitive.material"), place));
    const std::pair result(static_cast<int>(materials_.size()) - 1,
                           mapping_.value_or(TextureMapping{}));
    used_.emplace(material, result);
    return result;
}

Material GltfMaterials::read(const tinygltf::Material& from, const std::string& place) {
    Material out;
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i)
        out.baseColour[i] =
            rangedFactor(document_, pbr.baseColorFactor[i], 0, 1, place + ".baseColorFactor");
    out.metallic = rangedFactor(document_, pbr.metallicFactor, 0, 1, place + ".metallicFactor");
    out.roughness = rangedFactor(document_, pbr.roughnessFactor, 0, 1, place + ".roughnessFactor");
    out.emission = emissionOf(document_, from, place);
    out.alphaCutoff = alphaCutoffOf(document_, from, place);
    out.doubleSided = from.doubleSided;
    constexpr float kMostNormalScale = 100;
    out.normalScale = rangedFactor(document_, from.normalTexture.scale, -kMostNormalScale,
                                   kMostNormalScale, place + ".normalTexture.scale");
    out.baseColourTexture = texture(pbr.baseColorTexture, true, place + ".baseColorTexture");
    out.metallicRoughnessTexture =
        texture(pbr.metallicRoughnessTexture, false, place + ".metallicRoughnessTexture");
    out.normalTexture = texture(plainInfo(from.normalTexture), false, place + ".normalTexture");
    out.emissionTexture = texture(from.emissiveTexture, true, place + ".emissiveTexture");
    return out;
}

int GltfMaterials::texture(const tinygltf::TextureInfo& info, bool srgb, const std::string& place) {
    if (info.index < 0) return -1;
    takeMapping(mappingOf(document_, info, place), place);
    const tinygltf::Texture& from = document_.at(document_.gltf.textures, info.index, place);
    return picture(from.source, srgb, place);
}

void GltfMaterials::takeMapping(const TextureMapping& wanted, const std::string& place) {
    if (!mapping_) mapping_ = wanted;
    if (*mapping_ != wanted)
        document_.refuse(place,
                         "all textures of a material must have the same texCoord and the same "
                         "KHR_texture_transform");
}

int GltfMaterials::picture(int image, bool srgb, const std::string& place) {
    if (const auto it = pictures_.find({image, srgb}); it != pictures_.end()) return it->second;
    if (textures_.size() == document_.limits.textures)
        document_.refuse(
            place, fmt::format("the model has more than {} textures", document_.limits.textures));
    const tinygltf::Image& from = document_.at(document_.gltf.images, image, place);
    textures_.push_back(decode(from, fmt::format("images[{}]", image)));
    textures_.back().srgb = srgb;
    const int index = static_cast<int>(textures_.size()) - 1;
    pictures_.emplace(std::pair(image, srgb), index);
    return index;
}

SurfaceTexture GltfMaterials::decode(const tinygltf::Image& image, const std::string& place) {
    SurfaceTexture out;
    const auto target = [&](Size size) -> PixelTarget {
        const ModelLimits& limits = document_.limits;
        if (size.width < 1 || size.height < 1 || size.width > limits.textureSide ||
            size.height > limits.textureSide)
            throw std::runtime_error(
                fmt::format("the picture has {}x{} pixels; at most {} per side are supported",
                            size.width, size.height, limits.textureSide));
        const std::size_t texels = static_cast<std::size_t>(size.width) * size.height;
        if (texels > limits.texels - texels_)
            throw std::runtime_error(fmt::format(
                "the textures of the model have more than {} pixels in total", limits.texels));
        texels_ += texels;
        out.size = size;
        out.texels.resize(texels);
        return {out.texels.front().data(), std::size_t{4} * size.width};
    };
    try {
        std::vector<std::uint8_t> file;
        std::span<const std::uint8_t> bytes = image.image;
        if (image.bufferView >= 0) {
            bytes = document_.view(image.bufferView, place);
        } else if (!image.uri.empty()) {
            file = boundedFile(fileInFolder(document_.folder, percentDecoded(image.uri)),
                               document_.limits.bytes - bytes_);
            bytes_ += file.size();
            bytes = file;
        }
        decodeImage(bytes, target, ImageAlpha::Kept);
    } catch (const ModelError&) {
        throw;
    } catch (const std::runtime_error& error) {
        document_.refuse(place + (image.uri.empty() ? "" : " " + image.uri), error.what());
    }
    return out;
}

}  // namespace mfar
