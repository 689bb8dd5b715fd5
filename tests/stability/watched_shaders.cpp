#include "tests/stability/watched_shaders.h"

#include "gles_shaders/shaders.h"

#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <vector>

// The build's shader texts, compiled in this namespace. mfar::shaders returns them with checks of
// their indices.
namespace mfar::embedded_shaders {
struct Source {
    std::string_view name, text;
};
std::span<const Source> all();
std::string_view source(std::string_view name);
}  // namespace mfar::embedded_shaders

namespace mfar::stress {
namespace {

const PlantedFault* planted = nullptr;

constexpr std::string_view kInside = R"(layout(std430, binding = 15) buffer OutOfRange {
    uint outOfRange[];
};
int watchIndex(int i, int n) {
    if (i < 0 || i >= n) atomicAdd(outOfRange[WATCHED], 1u);
    return clamp(i, 0, max(n - 1, 0));
}
uint watchIndex(uint i, int n) {
    if (i >= uint(n)) atomicAdd(outOfRange[WATCHED], 1u);
    return min(i, uint(max(n - 1, 0)));
}
ivec2 watchIndex(ivec2 p, ivec2 n) {
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, n))) atomicAdd(outOfRange[WATCHED], 1u);
    return clamp(p, ivec2(0), max(n - 1, ivec2(0)));
}
#define texelFetch(s, p, l) texelFetch(s, watchIndex(p, textureSize(s, l)), l)
#define imageStore(i, p, v) imageStore(i, watchIndex(p, imageSize(i)), v)
)";

bool isName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// An array of a storage block. `length`: GLSL expression for its length without the guard bytes
/// behind the buffer.
struct StorageArray {
    std::string name, length;
};

std::string guardOf(std::string_view type) {
    constexpr int kGuardBytes = 256;  // same number as in gpu::Validation
    int components = type.back() - '0';
    if (!(components >= 2 && components <= 4)) components = 1;
    return std::to_string(kGuardBytes / (4 * components));
}

void addArrays(std::string_view block, std::vector<StorageArray>& out) {
    for (auto open = block.find('['); open != std::string_view::npos;
         open = block.find('[', open + 1)) {
        const auto close = block.find(']', open);
        auto first = open;
        while (first > 0 && isName(block[first - 1]))
            --first;
        auto typeEnd = first;
        while (typeEnd > 0 && block[typeEnd - 1] == ' ')
            --typeEnd;
        auto type = typeEnd;
        while (type > 0 && isName(block[type - 1]))
            --type;
        const std::string name(block.substr(first, open - first));
        std::string length(block.substr(open + 1, close - open - 1));
        if (length.empty())
            length = name + ".length() - " + guardOf(block.substr(type, typeEnd - type));
        out.push_back({name, length});
    }
}

/// Wraps every index of these arrays in watchIndex(), including an index inside another index.
std::string withIndices(std::string_view text, const std::vector<StorageArray>& arrays) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && isName(text[end]))
            ++end;
        if (end == i) {
            out += text[i++];
            continue;
        }
        const std::string_view word = text.substr(i, end - i);
        out += word;
        i = end;
        if (i >= text.size() || text[i] != '[') continue;
        for (const StorageArray& array : arrays) {
            if (array.name != word) continue;
            std::size_t close = i;
            for (int depth = 0; close < text.size(); ++close) {
                depth += text[close] == '[' ? 1 : 0;
                depth -= text[close] == ']' ? 1 : 0;
                if (depth == 0) break;
            }
            out += "[watchIndex(" + withIndices(text.substr(i + 1, close - i - 1), arrays) + ", " +
                   array.length + ")]";
            i = close + 1;
            break;
        }
    }
    return out;
}

std::size_t replaceAll(std::string& text, std::string_view from, std::string_view to) {
    std::size_t count = 0;
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
        ++count;
    }
    return count;
}

std::string prepared(std::string_view name, std::size_t index) {
    std::string text(embedded_shaders::source(name));
    if (planted != nullptr && name == planted->shader) replaceAll(text, planted->from, planted->to);
    return watched(text, index);
}

std::span<const shaders::Source> preparedShaders() {
    static std::vector<std::string> texts;
    static std::vector<shaders::Source> sources;
    if (!sources.empty()) return sources;
    const auto embedded = embedded_shaders::all();
    texts.reserve(embedded.size());
    for (std::size_t i = 0; i < embedded.size(); ++i) {
        texts.push_back(prepared(embedded[i].name, i));
        sources.push_back({embedded[i].name, texts.back()});
    }
    return sources;
}

}  // namespace

std::string watchedName(std::size_t index) {
    return std::string(embedded_shaders::all()[index].name);
}

std::string watched(std::string_view text, std::size_t index) {
    std::vector<StorageArray> arrays;
    std::string out;
    std::size_t done = 0;
    constexpr std::string_view kBuffer = " buffer ";
    for (auto at = text.find(kBuffer); at != std::string_view::npos;
         at = text.find(kBuffer, at + 1)) {
        // " buffer " may also occur in a comment. The line of a storage block begins with its
        // layout.
        const auto line = text.rfind('\n', at) + 1;
        if (text.substr(line, 6) != "layout") continue;
        const auto open = text.find('{', at), close = text.find('}', at);
        addArrays(text.substr(open, close - open), arrays);
        out += withIndices(text.substr(done, line - done), arrays);
        out += text.substr(line, close - line);
        done = close;
    }
    out += withIndices(text.substr(done), arrays);
    std::string head(kInside);
    replaceAll(head, "WATCHED", std::to_string(index));
    return head + "#line 1\n" + out;
}

void requirePlantable(const PlantedFault& fault) {
    std::string text(embedded_shaders::source(fault.shader));
    if (replaceAll(text, fault.from, fault.to) != 1)
        throw std::runtime_error(std::string(fault.shader) +
                                 " does not contain exactly once: " + fault.from);
}

void plant(const PlantedFault& fault) {
    requirePlantable(fault);
    planted = &fault;
}

}  // namespace mfar::stress

namespace mfar::shaders {

std::span<const Source> all() {
    return stress::preparedShaders();
}

std::string_view source(std::string_view name) {
    for (const Source& s : all())
        if (s.name == name) return s.text;
    throw std::out_of_range("there is no shader " + std::string(name));
}

}  // namespace mfar::shaders
