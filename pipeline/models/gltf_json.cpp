#include "pipeline/models/gltf_document.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

using nlohmann::json;

constexpr int kDeepestJson = 64;

[[noreturn]] void wrong(std::string_view place, std::string_view what) {
    throw std::runtime_error(fmt::format("{}: {}", place, what));
}

json parseBounded(std::string_view text, std::size_t most) {
    std::size_t values = 0;
    const auto count = [&](int depth, json::parse_event_t /*event*/, json& /*parsed*/) {
        if (depth > kDeepestJson)
            throw std::runtime_error(
                fmt::format("the JSON is nested more than {} levels deep", kDeepestJson));
        if (++values > most)
            throw std::runtime_error(
                fmt::format("the JSON has more than {} values, keys and brackets", most));
        return true;
    };
    try {
        return json::parse(text, count);
    } catch (const json::exception& error) {
        throw std::runtime_error(fmt::format("is not a glTF file: {}", error.what()));
    }
}

/// Returns the whole number under `key`: a number of bytes or an index. Returns `missing` if the
/// object has no such key. Refuses negative numbers. Refuses floating-point numbers, because they
/// may exceed 64 bits.
std::uint64_t bytesAt(const json& object, const char* key, std::uint64_t missing,
                      std::string_view place) {
    const auto it = object.find(key);
    if (it == object.end()) return missing;
    if (!it->is_number_unsigned())
        wrong(place, fmt::format("{} must be a whole number, not negative", key));
    return it->get<std::uint64_t>();
}

const json& listOf(const json& root, const char* key) {
    static const json kNone = json::array();
    const auto it = root.find(key);
    return it == root.end() ? kNone : *it;
}

void checkLists(const json& root, const ModelLimits& limits) {
    constexpr std::array kLists = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                   "images",    "materials",  "meshes",  "nodes",       "samplers",
                                   "scenes",    "skins",      "textures"};
    for (const char* key : kLists) {
        const json& list = listOf(root, key);
        if (!list.is_array()) wrong(key, "must be a list");
        if (list.size() > limits.elements)
            wrong(key, fmt::format("has {} entries; at most {} are supported", list.size(),
                                   limits.elements));
        for (std::size_t i = 0; i < list.size(); ++i)
            if (!list[i].is_object()) wrong(fmt::format("{}[{}]", key, i), "must be an object");
    }
}

void checkBuffers(const json& buffers, const ModelLimits& limits) {
    std::uint64_t left = limits.bytes;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string place = fmt::format("buffers[{}]", i);
        const std::uint64_t length = bytesAt(buffers[i], "byteLength", 0, place);
        if (length == 0) wrong(place, "byteLength is missing or 0");
        if (length > left)
            wrong(place,
                  fmt::format("byteLength {}: all buffers together exceed the limit of {} bytes",
                              length, limits.bytes));
        left -= length;
    }
}

void checkViews(const json& views, const json& buffers) {
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string place = fmt::format("bufferViews[{}]", i);
        const std::uint64_t buffer =
            bytesAt(views[i], "buffer", std::numeric_limits<std::uint64_t>::max(), place);
        if (buffer >= buffers.size()) wrong(place, "must name an existing buffer");
        const std::uint64_t holds = bytesAt(buffers[buffer], "byteLength", 0, place);
        const std::uint64_t offset = bytesAt(views[i], "byteOffset", 0, place);
        const std::uint64_t length = bytesAt(views[i], "byteLength", 0, place);
        if (length == 0) wrong(place, "byteLength is missing or 0");
        if (offset > holds || length > holds - offset)
            wrong(place, fmt::format("{} bytes at offset {} reach beyond the buffer of {} bytes",
                                     length, offset, holds));
    }
}

/// Refuses a negative byteOffset of sparse accessors, because not all releases of tinygltf treat it
/// in the same way.
void checkSparse(const json& accessors) {
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const auto sparse = accessors[i].find("sparse");
        if (sparse == accessors[i].end()) continue;
        for (const char* part : {"indices", "values"}) {
            const std::string place = fmt::format("accessors[{}].sparse.{}", i, part);
            if (!sparse->is_object() || !sparse->contains(part) || !(*sparse)[part].is_object())
                wrong(place, "must be an object");
            static_cast<void>(bytesAt((*sparse)[part], "byteOffset", 0, place));
        }
    }
}

void checkImages(const json& images, const json& views) {
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto it = images[i].find("bufferView");
        if (it == images[i].end()) continue;
        const std::string place = fmt::format("images[{}]", i);
        if (bytesAt(images[i], "bufferView", 0, place) >= views.size())
            wrong(place, "must name an existing bufferView");
    }
}

}  // namespace

void requireSoundJson(std::string_view text, const ModelLimits& limits) {
    const json root = parseBounded(text, limits.jsonValues);
    if (!root.is_object()) throw std::runtime_error("the JSON must be an object");
    checkLists(root, limits);
    checkBuffers(listOf(root, "buffers"), limits);
    checkViews(listOf(root, "bufferViews"), listOf(root, "buffers"));
    checkSparse(listOf(root, "accessors"));
    checkImages(listOf(root, "images"), listOf(root, "bufferViews"));
}

}  // namespace mfar
