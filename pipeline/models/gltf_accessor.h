#pragma once

#include "pipeline/models/gltf_document.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Reads an accessor's numbers, `components` (1 to 4) per element, one element after the other.
/// Normalised integers become [0, 1] or [-1, 1]. Sparse elements are replaced. Refuses an invalid
/// index, type or range, more than `most` elements, and numbers that are not finite.
[[nodiscard]] std::vector<float> accessorFloats(const GltfDocument& document, int accessor,
                                                int components, std::size_t most,
                                                std::string_view place);

/// Reads an accessor's unsigned integers, one per element. Refuses the same faults.
[[nodiscard]] std::vector<std::uint32_t> accessorIndices(const GltfDocument& document, int accessor,
                                                         std::size_t most, std::string_view place);

}  // namespace mfar
