#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace mfar {

/// A model or picture cannot be read. The message is one line "file: place: fault".
class ModelError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Limits of a model. Vertices and triangles count as often as nodes show them.
struct ModelLimits {
    std::size_t bytes = std::size_t{256} << 20U;  ///< sum over all its files
    std::size_t vertices = 4'000'000;
    std::size_t triangles = 4'000'000;
    std::size_t elements = 100'000;  ///< per list of the document: nodes, accessors, ...
    int nodeDepth = 64;
    std::size_t textures = 128;
    int textureSide = 8192;                       ///< [px]
    std::size_t texels = std::size_t{64} << 20U;  ///< sum over all textures
    std::size_t jsonValues = 2'000'000;           ///< in the document
    /// Upper limit of coordinates after all transforms [m].
    float farthest = 10'000;
};

/// Limits with which reading a model takes at most about this number of bytes; afterwards it takes
/// less. Never above the default limits.
[[nodiscard]] ModelLimits limitsWithin(std::size_t bytes);

/// Memory that a model takes [byte].
[[nodiscard]] std::size_t memoryOf(const Model& model);

/// Reads glTF 2.0, .glb or .gltf, whose buffers and pictures are inside the file or are files in
/// its folder or below. The model is rotated from glTF's y-up to z-up: (x, y, z) -> (x, -z, y), so
/// that a front in direction +z faces -y.
///
/// Supported: nodes (matrix or TRS), triangles, strips and fans, normals, tangents (computed where
/// a normal texture needs them), one set of texture coordinates a material, metallic-roughness with
/// its textures (PNG, JPEG; all repeat), emission, alpha mask, double sides, KHR_texture_transform,
/// KHR_materials_emissive_strength. Alpha mode BLEND counts as a mask with cutoff 0.5. Ignored:
/// points and lines, vertex colours, occlusion textures, animations, skins and morph targets (shown
/// at rest), cameras, lights, and extensions that are not required.
/// Throws ModelError for everything else, and for a model beyond `limits`.
/// Source: Khronos, glTF 2.0 Specification, 2.0.1.
[[nodiscard]] Model loadGltf(const std::filesystem::path& file, const ModelLimits& limits = {});

/// As loadGltf(), for a file's bytes. `name` is for messages. Empty folder: other files are
/// refused.
[[nodiscard]] Model parseGltf(std::span<const std::uint8_t> bytes, const std::string& name,
                              const std::filesystem::path& folder = {},
                              const ModelLimits& limits = {});

}  // namespace mfar
