#pragma once

#include <span>
#include <string_view>

namespace mfar::shaders {

struct Source {
    std::string_view name;  ///< file name, for example "flow_search.comp"
    std::string_view text;  ///< source with all #include lines resolved, without #version
};

/// All shaders of the program, embedded at build time.
[[nodiscard]] std::span<const Source> all();
/// Source of one shader. Throws std::out_of_range if the name does not exist.
[[nodiscard]] std::string_view source(std::string_view name);

}  // namespace mfar::shaders
