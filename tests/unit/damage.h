#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace mfar::test {

/// Returns `text` after one to four random edits. An edit replaces or inserts a character, or
/// removes up to seven. New characters have a meaning in YAML and CSV, or are invalid UTF-8.
inline std::string damaged(std::string text, std::mt19937& random) {
    constexpr std::string_view kLetters = "0123456789.,-+eE#:[]{}&*!|>'\"%@\n\r\t \xff\x80"
                                          "anif/";
    for (auto n = random() % 4 + 1; n > 0; --n) {
        const std::size_t at = random() % text.size();
        switch (random() % 3) {
        case 0: text[at] = kLetters[random() % kLetters.size()]; break;
        case 1: text.insert(at, 1, kLetters[random() % kLetters.size()]); break;
        default: text.erase(at, random() % 8); break;
        }
    }
    return text;
}

}  // namespace mfar::test
