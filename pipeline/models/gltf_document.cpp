#define TINYGLTF_IMPLEMENTATION
#include "pipeline/models/gltf_document.h"

#include "base/bounded_file.h"
#include "pipeline/models/named_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace mfar {
namespace {

constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;

std::uint32_t littleEndian(const std::uint8_t* p) {
    return std::uint32_t{p[3]} << 24U | std::uint32_t{p[2]} << 16U | std::uint32_t{p[1]} << 8U |
           p[0];
}

bool isBinary(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::string_view jsonOf(std::span<const std::uint8_t> bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    if (!isBinary(bytes)) return {text, bytes.size()};
    if (bytes.size() < kGlbHeader + kChunkHeader)
        throw std::runtime_error("the file ends within the .glb header");
    const std::uint32_t version = littleEndian(&bytes[4]);
    if (version != 2)
        throw std::runtime_error(
            fmt::format("version {} of .glb is not supported; expected 2", version));
    const std::uint32_t length = littleEndian(&bytes[kGlbHeader]);
    const std::size_t left = bytes.size() - kGlbHeader - kChunkHeader;
    if (length > left)
        throw std::runtime_error(
            fmt::format("the .glb states {} bytes of JSON but has only {}", length, left));
    return {text + kGlbHeader + kChunkHeader, length};
}

struct FolderAccess {
    const std::filesystem::path& folder;
    std::size_t left;
};

bool readFile(std::vector<unsigned char>* out, std::string* error, const std::string& uri,
              void* access) {
    auto* from = static_cast<FolderAccess*>(access);
    try {
        *out = boundedFile(fileInFolder(from->folder, uri), from->left);
        from->left -= out->size();
        return true;
    } catch (const std::exception& e) {
        *error = e.what();
        return false;
    }
}

/// Returns a complete set of callbacks for file access, because tinygltf replaces a missing
/// callback by its own. tinygltf asks FileExists about several paths for a URI. FileExists accepts
/// the first of them, the URI itself.
template <typename Callbacks>
Callbacks callbacksFor(FolderAccess& access) {
    Callbacks out{};
    out.FileExists = [](const std::string&, void*) { return true; };
    out.ExpandFilePath = [](const std::string& path, void*) { return path; };
    out.ReadWholeFile = readFile;
    out.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                            void*) { return false; };
    // Only newer releases of tinygltf have this callback. It reports size 0, because readFile()
    // limits the number of bytes itself.
    if constexpr (requires { out.GetFileSizeInBytes; })
        out.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
            *size = 0;
            return true;
        };
    out.user_data = &access;
    return out;
}

/// tinygltf calls this function for each picture in a data URI or a bufferView, but not for picture
/// files (TINYGLTF_NO_EXTERNAL_IMAGE); GltfMaterials reads these. Keeps the encoded bytes of a
/// picture from a data URI. A picture in a bufferView is not copied.
bool keepImage(tinygltf::Image* image, int /*index*/, std::string* /*error*/,
               std::string* /*warning*/, int /*width*/, int /*height*/, const unsigned char* bytes,
               int size, void* /*user*/) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string oneLine(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text;
}

void parse(std::span<const std::uint8_t> bytes, GltfDocument& document) {
    FolderAccess access{document.folder, document.limits.bytes};
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keepImage, nullptr);
    parser.SetFsCallbacks(callbacksFor<tinygltf::FsCallbacks>(access));
    const auto size = static_cast<unsigned>(bytes.size());
    std::string error, warning;
    const bool good =
        isBinary(bytes)
            ? parser.LoadBinaryFromMemory(&document.gltf, &error, &warning, bytes.data(), size, "")
            : parser.LoadASCIIFromString(&document.gltf, &error, &warning,
                                         reinterpret_cast<const char*>(bytes.data()), size, "");
    if (!good)
        throw std::runtime_error(error.empty() ? "tinygltf cannot read the file" : oneLine(error));
}

void requireVersionAndExtensions(const GltfDocument& document) {
    if (!document.gltf.asset.version.starts_with("2."))
        document.refuse("asset.version", fmt::format("\"{}\" is not supported; expected 2.0",
                                                     document.gltf.asset.version));
    for (const std::string& name : document.gltf.extensionsRequired)
        if (name != "KHR_texture_transform" && name != "KHR_materials_emissive_strength")
            document.refuse("extensionsRequired",
                            fmt::format("{} is not supported; only KHR_texture_transform and "
                                        "KHR_materials_emissive_strength are",
                                        name));
}

}  // namespace

std::string GltfDocument::sentence(std::string_view place, std::string_view what) const {
    return oneLine(fmt::format("{}: {}: {}", name, place, what));
}

void GltfDocument::refuse(std::string_view place, std::string_view what) const {
    throw ModelError(sentence(place, what));
}

std::span<const std::uint8_t> GltfDocument::view(int bufferView, std::string_view place) const {
    const tinygltf::BufferView& view = at(gltf.bufferViews, bufferView, place);
    const std::span<const std::uint8_t> buffer = at(gltf.buffers, view.buffer, place).data;
    // The sizes in the JSON agree (see requireSoundJson()), but tinygltf may have made a smaller
    // buffer.
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        refuse(place, fmt::format("bufferView {} reaches beyond its buffer", bufferView));
    return buffer.subspan(view.byteOffset, view.byteLength);
}

GltfDocument readDocument(std::span<const std::uint8_t> bytes, const std::string& name,
                          const std::filesystem::path& folder, const ModelLimits& limits) {
    GltfDocument document{{}, name, folder, limits};
    try {
        const auto most = std::min<std::uint64_t>(limits.bytes, UINT32_MAX);
        if (bytes.size() > most)
            throw std::runtime_error(
                fmt::format("has {} bytes; the limit is {} bytes", bytes.size(), most));
        if (bytes.empty()) throw std::runtime_error("is empty");
        requireSoundJson(jsonOf(bytes), limits);
        parse(bytes, document);
    } catch (const std::exception& error) {
        throw ModelError(oneLine(fmt::format("{}: {}", name, error.what())));
    }
    requireVersionAndExtensions(document);
    return document;
}

}  // namespace mfar
