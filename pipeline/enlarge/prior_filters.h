#pragma once

#include <cstdint>
#include <span>

namespace mfar::enlarge {

/// The bytes of the file prior.filters (the shipped filters), which the build embeds in the
/// program.
[[nodiscard]] std::span<const std::uint8_t> priorFilters();

}  // namespace mfar::enlarge
