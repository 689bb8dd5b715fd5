#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

/// The interface of a fuzz target: it reads one input and returns 0. If there is a fault, the
/// process ends: by the report of a sanitizer, or by an exception that the tested header does not
/// document.
// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mfar::test {

[[nodiscard]] inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline void requireThat(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

}  // namespace mfar::test
