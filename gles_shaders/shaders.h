#pragma once

#include <span>
#include <string_view>

namespace mfar::shaders {

struct Source {
    std::string_view name;
    std::string_view text;  ///< with all #include lines resolved, without #version
};

/// All shaders of mfar, embedded at build time.
[[nodiscard]] std::span<const Source> all();
/// Returns the text of the shader with this file name. Throws std::out_of_range if there is none.
[[nodiscard]] std::string_view source(std::string_view name);

}  // namespace mfar::shaders
