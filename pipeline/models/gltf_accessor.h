#pragma once

#include "pipeline/models/gltf_document.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace mfar {

/// Returns the numbers of an accessor. Each element has `components` (1 to 4) numbers, one after
/// the other. Normalised integers become [0, 1] or [-1, 1]. Values in accessor.sparse replace
/// single elements. Refuses an invalid index, type or range, an accessor with no elements or with
/// more than `most`, and numbers that are not finite. The error message contains `place`, the
/// position in the document.
[[nodiscard]] std::vector<float> accessorFloats(const GltfDocument& document, int accessor,
                                                int components, std::size_t most,
                                                std::string_view place);

/// Reads the unsigned integers of an accessor, one per element. Refuses the same faults as
/// accessorFloats(), and also other types of numbers and accessor.sparse.
[[nodiscard]] std::vector<std::uint32_t> accessorIndices(const GltfDocument& document, int accessor,
                                                         std::size_t most, std::string_view place);

}  // namespace mfar
