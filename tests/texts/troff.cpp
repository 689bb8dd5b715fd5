#include "tests/texts/troff.h"

#include <fmt/format.h>

namespace mfar::test {

std::string troff(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\n')
            out += ' ';
        else
            out += c;
    }
    return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string head(std::string_view name, int section, std::string_view about,
                 std::string_view source) {
    return fmt::format(".\\\" Printed by mfar-texts from {3}.\n"
                       ".TH {0} {1} \"\" mfar\n.SH NAME\n{4} \\- {2}\n",
                       name, section, troff(about), source, troff(name));
}

std::string entry(std::string_view key, std::string_view text) {
    return fmt::format(".TP\n.B {}\n{}\n", troff(key), troff(text));
}

std::string entry(const ArgumentText& argument) {
    const bool isPlain = argument.isPositional() || argument.value.empty();
    return entry(argument.names + (isPlain ? "" : " " + argument.value), argument.meaning);
}

}  // namespace mfar::test
