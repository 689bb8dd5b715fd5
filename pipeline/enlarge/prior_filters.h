#pragma once

#include <cstdint>
#include <span>

namespace mfar::enlarge {

/// The bytes of prior.filters, which the build puts into the program.
[[nodiscard]] std::span<const std::uint8_t> priorFilters();

}  // namespace mfar::enlarge
