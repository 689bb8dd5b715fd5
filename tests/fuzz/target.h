#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

/// What a fuzz target is: it reads one input and returns 0. A fault ends the process: what the
/// sanitizers see, or an exception other than those that the room's header names.
// NOLINTNEXTLINE(readability-identifier-naming): its name for libFuzzer
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace mfar::test {

[[nodiscard]] inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// For what must hold of an answer.
inline void requireThat(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

}  // namespace mfar::test
