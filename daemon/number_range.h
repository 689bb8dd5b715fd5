#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>

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

/// Returns true for a whole number that CLI11 would read as an octal one, such as "010".
[[nodiscard]] inline bool hasLeadingZero(std::string_view text) {
    return text.size() > 1 && text[0] == '0' && text[1] >= '0' && text[1] <= '9';
}

/// Validator of an option whose value is an unsigned integer of 64 bits. Without it, CLI11 turns
/// negative and too large numbers and those with leading zeros into other ones, for example -1 and
/// 2^64 into 2^64 - 1, and 010 into 8.
[[nodiscard]] inline CLI::Validator unsigned64() {
    return CLI::Validator(
        [](const std::string& text) {
            if (text.find('-') != std::string::npos) return text + " is negative";
            if (hasLeadingZero(text)) return text + " has a leading zero";
            errno = 0;
            static_cast<void>(std::strtoull(text.c_str(), nullptr, 0));
            return errno == ERANGE ? text + " exceeds 2^64 - 1" : std::string();
        },
        "");
}

}  // namespace mfar
