#pragma once

#include "pipeline/models/gltf_model.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace mfar {

/// What a glTF file says. All bufferViews lie in their buffers; other indices and numbers are as
/// they stand in the file.
struct GltfDocument {
    tinygltf::Model gltf;
    std::string name;              ///< for messages
    std::filesystem::path folder;  ///< of files it names; empty: it may name none
    ModelLimits limits;

    /// Throws ModelError "name: place: what".
    [[noreturn]] void refuse(std::string_view place, std::string_view what) const;
    /// What a list holds at an index. Refuses one that is out of range.
    template <class T>
    [[nodiscard]] const T& at(const std::vector<T>& list, int index, std::string_view place) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            refuse(place, "index " + std::to_string(index) + " of " + std::to_string(list.size()));
        return list[static_cast<std::size_t>(index)];
    }
    /// The bytes of a bufferView.
    [[nodiscard]] std::span<const std::uint8_t> view(int bufferView, std::string_view place) const;
};

/// Throws ModelError.
[[nodiscard]] GltfDocument readDocument(std::span<const std::uint8_t> bytes,
                                        const std::string& name,
                                        const std::filesystem::path& folder,
                                        const ModelLimits& limits);

/// Looks through the JSON of a document before tinygltf does: it trusts ranges of images, copies a
/// buffer's bytes for each that says so, and follows `extras` as deep as they go. Throws
/// std::runtime_error "place: what is wrong".
void requireSoundJson(std::string_view text, const ModelLimits& limits);

}  // namespace mfar
