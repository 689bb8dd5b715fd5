#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace mfar {

/// Thrown if a model or picture cannot be read. The message is one line: "file: place: fault", or
/// "file: fault" if the fault concerns the whole file.
class ModelError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Upper limits for a model. A mesh that several nodes show counts once for each node.
struct ModelLimits {
    /// Limit of three numbers of bytes: of the glTF file, of all buffers together, and of all
    /// picture files together.
    std::size_t bytes = std::size_t{256} << 20U;
    std::size_t vertices = 4'000'000;
    std::size_t triangles = 4'000'000;
    /// Largest number of entries in each list of the document (nodes, accessors, ...), of nodes
    /// that are shown, and of times of an animation's track.
    std::size_t elements = 100'000;
    int nodeDepth = 64;
    std::size_t textures = 128;
    int textureSide = 8192;                       ///< largest width and height of a texture [px]
    std::size_t texels = std::size_t{64} << 20U;  ///< in all textures together
    std::size_t jsonValues = 2'000'000;
    /// Keyframes of all tracks together. A track counts when it is read, and once more for each
    /// moving node that it moves, directly or because it moves an ancestor of the node.
    std::size_t keyframes = 1'000'000;
    /// Largest absolute value of each coordinate of a vertex after all transforms [m], and of each
    /// coordinate of a moving node's translations [m] and their tangents [m/s].
    float farthest = 10'000;
};

/// Returns limits with which reading a model takes at most about `bytes` bytes of memory. No limit
/// is above its default. The finished model takes less memory.
[[nodiscard]] ModelLimits limitsWithin(std::size_t bytes);

[[nodiscard]] std::size_t memoryOf(const Model& model);

/// Reads a glTF 2.0 file, .glb or .gltf. Its buffers and pictures must be inside the file, or be
/// files in its folder or in folders below. In glTF, y is up; the model is rotated so that z is up:
/// (x, y, z) -> (x, -z, y). A front that faces +z in glTF then faces -y.
///
/// Supported: nodes (matrix or TRS), triangles, strips and fans, normals, tangents (computed where
/// a normal texture needs them), one set of texture coordinates per material, metallic-roughness
/// with textures (PNG, JPEG; all repeat), emission, alpha mask, double-sided surfaces,
/// KHR_texture_transform, KHR_materials_emissive_strength. Alpha mode BLEND is treated as a mask
/// with cutoff 0.5. Also supported: translations and rotations of up to 16 nodes in the first
/// animation, which repeats.
/// Ignored: points and lines, vertex colours, occlusion textures, cameras, lights, and extensions
/// that are not required. Ignored with a sentence in Model::notes: other animations, the motion of
/// further nodes and of nodes below an unequal or mirroring scale, changing scales, skins and morph
/// targets. Throws ModelError for everything else, and if the model exceeds `limits`. Source:
/// Khronos, glTF 2.0 Specification, 2.0.1.
[[nodiscard]] Model loadGltf(const std::filesystem::path& file, const ModelLimits& limits = {});

/// Reads the bytes of a glTF file. `name` is its name in error messages. The model may refer to
/// files in `folder`. If `folder` is empty, references to files are refused.
[[nodiscard]] Model parseGltf(std::span<const std::uint8_t> bytes, const std::string& name,
                              const std::filesystem::path& folder = {},
                              const ModelLimits& limits = {});

}  // namespace mfar
