#include "tests/texts/pages.h"

#include <fmt/format.h>

#include <set>

namespace mfar::test {

std::string fuzzDictionary(std::span<const OptionSection> table, std::string_view entries) {
    std::set<std::string> keys, sections;
    for (const OptionSection& section : table) {
        const bool isList = section.kind == OptionSection::Kind::List;
        if (!section.name.empty())
            sections.insert(fmt::format("\"{}{}{}\\x0a\"\n", isList ? "[[" : "[", section.name,
                                        isList ? "]]" : "]"));
        for (const Option& option : section.options)
            keys.insert(fmt::format("\"{} = \"\n", option.name));
    }
    std::string out;
    for (const std::set<std::string>& all : {keys, sections})
        for (const std::string& one : all)
            out += one;
    return out.append(entries);
}

}  // namespace mfar::test
