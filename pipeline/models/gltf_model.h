#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace mfar {

/// A model or picture cannot be read. One line "file: place: what is wrong".
class ModelError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a model may cost. Vertices and triangles count as often as nodes show them.
struct ModelLimits {
    std::size_t bytes = std::size_t{256} << 20U;  ///< of all its files together
    std::size_t vertices = 4'000'000;
    std::size_t triangles = 4'000'000;
    std::size_t elements = 100'000;  ///< of each list of the document: nodes, accessors, ...
    int nodeDepth = 64;
    std::size_t textures = 128;
    int textureSide = 8192;                       ///< [px]
    std::size_t texels = std::size_t{64} << 20U;  ///< of all textures together
    std::size_t jsonValues = 2'000'000;           ///< of the document
    float farthest = 10'000;                      ///< coordinates after all transforms [m]
};

/// Limits with which a model takes no more than about so many bytes while it is read, and less
/// afterwards. Never above the default ones.
[[nodiscard]] ModelLimits limitsWithin(std::size_t bytes);

/// What a model takes [byte].
[[nodiscard]] std::size_t memoryOf(const Model& model);

/// Reads glTF 2.0, .glb or .gltf, whose buffers and pictures are inside it, or files in its folder
/// or below. What it shows is turned from glTF's y up to z up: (x, y, z) -> (x, -z, y), so that a
/// thing that faces glTF's +z faces -y.
///
/// Read: nodes (matrix or TRS), triangles, strips and fans, normals, tangents (made where a normal
/// texture needs them), one set of texture coordinates a material, metallic-roughness with its
/// textures (PNG, JPEG; all repeat), emission, alpha mask, double sides, KHR_texture_transform,
/// KHR_materials_emissive_strength. Alpha mode BLEND is taken for a mask with cutoff 0.5. Left
/// aside: points and lines, vertex colours, occlusion textures, animations, skins and morph targets
/// (at rest), cameras, lights, and extensions that are not required.
/// Throws ModelError for everything else, and for a model beyond `limits`.
/// Source: Khronos, glTF 2.0 Specification, 2.0.1.
[[nodiscard]] Model loadGltf(const std::filesystem::path& file, const ModelLimits& limits = {});

/// The same for a file's bytes. `name` is for messages. An empty folder: it must be in one piece.
[[nodiscard]] Model parseGltf(std::span<const std::uint8_t> bytes, const std::string& name,
                              const std::filesystem::path& folder = {},
                              const ModelLimits& limits = {});

}  // namespace mfar
