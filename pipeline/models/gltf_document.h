#pragma once

#include "pipeline/models/gltf_model.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace mfar {

/// The content of a glTF file. According to its JSON, all bufferViews are inside their buffers (see
/// requireSoundJson()). Other indices and numbers are not validated.
struct GltfDocument {
    tinygltf::Model gltf;
    std::string name;
    /// Folder of the files to which the document may refer. If `folder` is empty, the document must
    /// not refer to files.
    std::filesystem::path folder;
    ModelLimits limits;

    /// Returns "name: place: what" on one line.
    [[nodiscard]] std::string sentence(std::string_view place, std::string_view what) const;
    /// Throws ModelError with the message sentence(place, what).
    [[noreturn]] void refuse(std::string_view place, std::string_view what) const;
    /// Returns list[index]. Refuses an index that is out of range.
    template <class T>
    [[nodiscard]] const T& at(const std::vector<T>& list, int index, std::string_view place) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            refuse(place, "index " + std::to_string(index) + " is out of range; there are " +
                              std::to_string(list.size()) + " entries");
        return list[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] std::span<const std::uint8_t> view(int bufferView, std::string_view place) const;
};

[[nodiscard]] GltfDocument readDocument(std::span<const std::uint8_t> bytes,
                                        const std::string& name,
                                        const std::filesystem::path& folder,
                                        const ModelLimits& limits);

/// Validates the JSON of a document before tinygltf reads it. tinygltf does not check the ranges of
/// images in buffers, copies the bytes of a buffer for each reference to it, and follows `extras`
/// to any depth. Throws std::runtime_error with the message "place: fault", or with the fault alone
/// if it concerns the whole document.
void requireSoundJson(std::string_view text, const ModelLimits& limits);

}  // namespace mfar
