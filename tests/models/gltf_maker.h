#pragma once

#include "base/image_view.h"
#include "pipeline/scene/scene.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mfar::test {

/// Builds a glTF document. It is valid unless the caller changes `root`.
class GltfMaker {
public:
    GltfMaker();

    /// Functions that add an accessor with its own bufferView and return the accessor's index.
    int floats(const std::vector<float>& values, int components);
    int shorts(const std::vector<std::uint16_t>& values);
    /// Adds an image in a bufferView and a texture of this image. Returns the texture's index.
    int texture(const std::vector<std::uint8_t>& file, const std::string& mime);
    /// Adds a mesh of one primitive, and a node of the scene with this mesh. Returns the primitive.
    nlohmann::json& mesh(int positions, int indices = -1);
    int view(const void* bytes, std::size_t count);
    /// Adds a channel to the first animation. `path`: translation, rotation or scale. Returns the
    /// channel's sampler.
    nlohmann::json& animate(int node, const std::string& path, const std::vector<float>& times,
                            const std::vector<float>& values);

    [[nodiscard]] std::vector<std::uint8_t> glb() const;
    /// The JSON text alone. Its buffer is the file "data.bin" with the bytes bin().
    [[nodiscard]] std::string gltf() const;
    [[nodiscard]] const std::vector<std::uint8_t>& bin() const { return bin_; }

    nlohmann::json root;

private:
    std::vector<std::uint8_t> bin_;
};

[[nodiscard]] Model modelOf(const GltfMaker& maker);  ///< parsed under the name "test.glb"
[[nodiscard]] GltfMaker oneTriangle();
/// A textured quad with normals and all material fields, in a small hierarchy.
[[nodiscard]] GltfMaker richModel();

[[nodiscard]] std::vector<std::uint8_t>
rgbaPng(Size size, const std::vector<std::array<std::uint8_t, 4>>& texels);

}  // namespace mfar::test
