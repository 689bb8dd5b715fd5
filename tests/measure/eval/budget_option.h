#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// Checks a budget of processor time [ms]; CLI::Range lets NaN pass.
inline std::string isBudget(const std::string& text) {
    double ms = -1;
    const bool number = CLI::detail::lexical_cast(text, ms);
    return number && ms >= 0.1 && ms <= 1000 ? "" : text + " is not in [0.1, 1000]";
}

}  // namespace mfar::eval
