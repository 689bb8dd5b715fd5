#pragma once

#include "pipeline/models/gltf_document.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Numbers of an accessor, `components` of them (1 to 4) an element, one element after the other.
/// Normalised integers become [0, 1] or [-1, 1]. Sparse elements are put in. Refuses an index, type
/// or range that is not sound, more than `most` elements, and numbers that are not finite.
[[nodiscard]] std::vector<float> accessorFloats(const GltfDocument& document, int accessor,
                                                int components, std::size_t most,
                                                std::string_view place);

/// Unsigned integers of an accessor, one an element. Refuses likewise.
[[nodiscard]] std::vector<std::uint32_t> accessorIndices(const GltfDocument& document, int accessor,
                                                         std::size_t most, std::string_view place);

}  // namespace mfar
