#pragma once

#include "base/geometry.h"
#include "daemon/number_range.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <utility>

namespace mfar::eval {

/// Validator of a budget of processor time [ms].
[[nodiscard]] inline CLI::Validator isBudget() {
    return numberFrom(0.1, 1000);
}

inline void addSize(CLI::App& sub, Size& size, const char* what) {
    const std::string help = fmt::format("size of the {} [px]", what);
    for (const auto& [name, side] : {std::pair("--width", &size.width), {"--height", &size.height}})
        sub.add_option(name, *side, help)->check(CLI::Range(16, 4096))->capture_default_str();
}

}  // namespace mfar::eval
