#include "daemon/config_ranges.h"
#include "tests/daemon/config_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace mfar {
namespace range {

std::ostream& operator<<(std::ostream& out, const ConfigRange& range) {
    return out << fmt::format("[{}] {}", range.section, range.name);
}

}  // namespace range
namespace {

using range::ConfigRange;
using testing::HasSubstr;
using testing::IsEmpty;

/// The default configuration's text about a key: its line and the comment lines before it.
std::string shown(const ConfigRange& range) {
    std::ifstream in(MFAR_DEFAULT_CONFIG);
    std::string comment, section;
    // Keys of optional sections are comments themselves.
    const std::string isKey = fmt::format("{} = ", range.name), isCommented = "# " + isKey;
    for (std::string line; std::getline(in, line);) {
        const std::string bare = line.starts_with("# [") ? line.substr(2) : line;
        if (bare.starts_with("[")) section = bare.substr(0, bare.rfind(']') + 1);
        const bool isHere = section == fmt::format("[{}]", range.section) ||
                            section == fmt::format("[[{}]]", range.section);
        if (isHere && line.starts_with(isCommented)) return line;
        if (isHere && line.starts_with(isKey)) return comment + line;
        // Consecutive keys share a comment.
        if (line.empty()) comment.clear();
        if (line.starts_with("#")) comment += line.substr(1);
    }
    return "";
}

std::string with(const ConfigRange& range, double value) {
    const bool isList = range.count > 1, isArray = range.section == "objects";
    const std::string text =
        range.isWhole ? fmt::format("{:.0f}", value) : fmt::format("{:.6f}", value);
    std::vector<std::string> all(static_cast<std::size_t>(range.count), text);
    if (range.hasLength1) std::fill(all.begin() + 1, all.end(), "0");
    return fmt::format("{0}{2}{1}\n{3} = {4}{5}{6}\n", isArray ? "[[" : "[", isArray ? "]]" : "]",
                       range.section, range.name, isList ? "[" : "", fmt::join(all, ", "),
                       isList ? "]" : "");
}

class ConfigRanges : public testing::TestWithParam<ConfigRange> {};

TEST_P(ConfigRanges, AreInTheDefaultConfiguration) {
    const ConfigRange& range = GetParam();
    const std::string text = shown(range);
    EXPECT_THAT(text, HasSubstr(fmt::format("{} to {}", range.least, range.most)));
    const std::string unit = range.unit.empty() ? "" : fmt::format("[{}]", range.unit);
    EXPECT_THAT(text, HasSubstr(unit));
}

TEST_P(ConfigRanges, AreWhatTheParserTakes) {
    const ConfigRange& range = GetParam();
    EXPECT_THAT(test::configFaults(with(range, range.least)), IsEmpty());
    EXPECT_THAT(test::configFaults(with(range, range.most)), IsEmpty());
    const std::string refused = fmt::format(" from {} to {}", range.least, range.most);
    const double step = range.isWhole ? 1 : 1e-6;
    for (const double value : {range.least - step, range.most + step, -1e12, 1e12})
        EXPECT_THAT(test::configFaults(with(range, value)), HasSubstr(refused)) << value;
}

std::string nameOf(const testing::TestParamInfo<ConfigRange>& of) {
    std::string out = fmt::format("{}_{}", of.param.section, of.param.name);
    for (char& c : out)
        if (c == '.') c = '_';
    return out;
}

INSTANTIATE_TEST_SUITE_P(All, ConfigRanges, testing::ValuesIn(range::kAll), nameOf);

}  // namespace
}  // namespace mfar
