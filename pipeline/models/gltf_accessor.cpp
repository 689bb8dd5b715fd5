#include "pipeline/models/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace mfar {
namespace {

using Accessor = tinygltf::Accessor;

/// Position and type of an accessor's elements in a bufferView.
struct ElementView {
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0, count = 0;
    int componentType = 0, components = 0;

    [[nodiscard]] const std::uint8_t* at(std::size_t element) const {
        return bytes.data() + element * stride;
    }
};

std::size_t bytesOf(int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: return 0;
    }
}

int componentsOf(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    default: return 0;
    }
}

template <class T>
T load(const std::uint8_t* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

std::uint32_t unsignedAt(const std::uint8_t* p, int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return *p;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load<std::uint16_t>(p);
    default: return load<std::uint32_t>(p);
    }
}

float floatAt(const std::uint8_t* p, int componentType, bool normalized) {
    const auto scaled = [&](auto value) {
        constexpr auto kMost = static_cast<float>(std::numeric_limits<decltype(value)>::max());
        const auto plain = static_cast<float>(value);
        return normalized ? std::max(plain / kMost, -1.0F) : plain;
    };
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(load<std::int8_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(load<std::uint8_t>(p));
    case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(load<std::int16_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled(load<std::uint16_t>(p));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return scaled(load<std::uint32_t>(p));
    default: return load<float>(p);
    }
}

/// Returns `wanted` with its bytes and its stride filled in. The caller has set the number and the
/// type of the elements. If `stride` is 0, the elements are tightly packed.
ElementView elementsIn(const GltfDocument& document, int bufferView, std::uint64_t offset,
                       std::size_t stride, ElementView wanted, std::string_view place) {
    const std::size_t one = bytesOf(wanted.componentType) * wanted.components;
    const std::span<const std::uint8_t> view = document.view(bufferView, place);
    wanted.stride = stride == 0 ? one : stride;
    if (wanted.stride < one)
        document.refuse(place,
                        fmt::format("byteStride is {}, but an element has {} bytes", stride, one));
    const std::uint64_t left = offset > view.size() ? 0 : view.size() - offset;
    // `count` is below 2^32 and `stride` is below 2^8, so the product cannot overflow.
    const std::uint64_t needed = std::uint64_t{wanted.count - 1} * wanted.stride + one;
    if (needed > left)
        document.refuse(
            place,
            fmt::format("needs {} bytes at offset {} of bufferView {}, which has only {} bytes",
                        needed, offset, bufferView, view.size()));
    wanted.bytes = view.subspan(offset);
    return wanted;
}

/// Returns the accessor with this index. Throws ModelError if the index or the componentType is
/// invalid, if its elements do not have `components` components, or if it has no elements or more
/// than `most`.
const Accessor& checkedAccessor(const GltfDocument& document, int index, int components,
                                std::size_t most, std::string_view place) {
    const Accessor& accessor = document.at(document.gltf.accessors, index, place);
    if (bytesOf(accessor.componentType) == 0 || componentsOf(accessor.type) != components)
        document.refuse(
            place,
            fmt::format("accessor {} must have {} numbers per element and a valid componentType",
                        index, components));
    if (accessor.count == 0 || accessor.count > most)
        document.refuse(place, fmt::format("accessor {} has {} elements; 1 to {} are supported",
                                           index, accessor.count, most));
    return accessor;
}

ElementView elementsOf(const GltfDocument& document, const Accessor& accessor, int components,
                       std::string_view place) {
    const std::size_t stride =
        document.at(document.gltf.bufferViews, accessor.bufferView, place).byteStride;
    return elementsIn(document, accessor.bufferView, accessor.byteOffset, stride,
                      {{}, 0, accessor.count, accessor.componentType, components}, place);
}

bool isIndexType(int componentType) {
    constexpr std::array kTypes = {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                   TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                   TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT};
    return std::find(kTypes.begin(), kTypes.end(), componentType) != kTypes.end();
}

void copyFloats(const ElementView& from, bool normalized, std::size_t element, float* to) {
    const std::uint8_t* p = from.at(element);
    for (int i = 0; i < from.components; ++i, p += bytesOf(from.componentType))
        to[i] = floatAt(p, from.componentType, normalized);
}

/// Replaces single elements by values stored elsewhere (glTF 2.0, 3.6.2.3).
void replaceSparse(const GltfDocument& document, const Accessor& accessor, int components,
                   std::string_view place, std::vector<float>& out) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count ||
        !isIndexType(sparse.indices.componentType))
        document.refuse(place,
                        fmt::format("invalid sparse elements: sparse.count must be from 1 to {}, "
                                    "and sparse.indices must be unsigned integers",
                                    accessor.count));
    const auto count = static_cast<std::size_t>(sparse.count);
    const ElementView indices = elementsIn(document, sparse.indices.bufferView,
                                           static_cast<std::uint64_t>(sparse.indices.byteOffset), 0,
                                           {{}, 0, count, sparse.indices.componentType, 1}, place);
    const ElementView values = elementsIn(
        document, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset), 0,
        {{}, 0, count, accessor.componentType, components}, place);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = unsignedAt(indices.at(i), indices.componentType);
        if (index >= accessor.count)
            document.refuse(place,
                            fmt::format("sparse index {} is out of range; there are {} elements",
                                        index, accessor.count));
        copyFloats(values, accessor.normalized, i, &out[std::size_t{index} * components]);
    }
}

}  // namespace

std::vector<float> accessorFloats(const GltfDocument& document, int accessor, int components,
                                  std::size_t most, std::string_view place) {
    const Accessor& source = checkedAccessor(document, accessor, components, most, place);
    std::vector<float> out(source.count * components);
    if (source.bufferView >= 0) {
        const ElementView elements = elementsOf(document, source, components, place);
        for (std::size_t i = 0; i < source.count; ++i)
            copyFloats(elements, source.normalized, i, &out[i * components]);
    }
    if (source.sparse.isSparse) replaceSparse(document, source, components, place, out);
    const auto bad =
        std::find_if(out.begin(), out.end(), [](float v) { return !std::isfinite(v); });
    if (bad != out.end())
        document.refuse(place, fmt::format("element {} is not finite",
                                           static_cast<std::size_t>(bad - out.begin()) /
                                               static_cast<std::size_t>(components)));
    return out;
}

std::vector<std::uint32_t> accessorIndices(const GltfDocument& document, int accessor,
                                           std::size_t most, std::string_view place) {
    const Accessor& source = checkedAccessor(document, accessor, 1, most, place);
    if (!isIndexType(source.componentType) || source.sparse.isSparse)
        document.refuse(
            place, fmt::format("accessor {} must have unsigned integers and no sparse elements",
                               accessor));
    const ElementView elements = elementsOf(document, source, 1, place);
    std::vector<std::uint32_t> out(source.count);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = unsignedAt(elements.at(i), elements.componentType);
    return out;
}

}  // namespace mfar
