#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <string>

namespace mfar {

/// Validator of an option whose value is a number in [least, most]. CLI::Range and
/// CLI::PositiveNumber are not used for such options because they accept NaN.
[[nodiscard]] inline CLI::Validator numberFrom(double least, double most) {
    return CLI::Validator(
        [least, most](const std::string& text) {
            double value = 0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= least && value <= most
                       ? std::string()
                       : fmt::format("{} is not in [{:g}, {:g}]", text, least, most);
        },
        fmt::format("FLOAT in [{:g} - {:g}]", least, most));
}

/// Validator of an option whose value is an unsigned integer. Without it, CLI11 turns -1 into
/// 2^64 - 1.
[[nodiscard]] inline CLI::Validator withoutSign() {
    return CLI::Validator(
        [](const std::string& text) {
            return text.find('-') == std::string::npos ? std::string() : text + " is negative";
        },
        "");
}

}  // namespace mfar
