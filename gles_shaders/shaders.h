#pragma once

#include <span>
#include <string_view>

namespace mfar::shaders {

struct Source {
    std::string_view name;  ///< file name, e.g. "flow_search.comp"
    std::string_view text;  ///< with every #include resolved, without #version
};

/// All shaders of the program, embedded at build time.
[[nodiscard]] std::span<const Source> all();
/// Text of one. Throws std::out_of_range for a name that does not exist.
[[nodiscard]] std::string_view source(std::string_view name);

}  // namespace mfar::shaders
