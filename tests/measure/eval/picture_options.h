#pragma once

#include "base/geometry.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <string>

namespace mfar::eval {

/// Validator of a budget of processor time [ms]. CLI::Range is not used because it accepts NaN.
inline std::string isBudget(const std::string& text) {
    double ms = -1;
    const bool number = CLI::detail::lexical_cast(text, ms);
    return number && ms >= 0.1 && ms <= 1000 ? "" : text + " is not in [0.1, 1000]";
}

inline void addSize(CLI::App& sub, Size& size, const char* what) {
    const std::string help = fmt::format("size of the {} [px]", what);
    for (const auto& [name, side] : {std::pair("--width", &size.width), {"--height", &size.height}})
        sub.add_option(name, *side, help)->check(CLI::Range(16, 4096))->capture_default_str();
}

}  // namespace mfar::eval
