#include "daemon/option_table.h"
#include "daemon/option_text.h"
#include "daemon/quality_table.h"
#include "daemon/rig_words.h"
#include "tests/daemon/config_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mfar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Key {
    const OptionSection* section;
    const Option* option;

    [[nodiscard]] std::string name() const {
        return fmt::format("{}{}{}", section->name, section->name.empty() ? "" : ".", option->name);
    }
};

std::vector<Key> keysOf(std::span<const OptionSection> table) {
    std::vector<Key> out;
    for (const OptionSection& section : table)
        for (const Option& option : section.options)
            out.push_back({&section, &option});
    return out;
}

bool isLevel(const Key& key) {
    return key.section == levelOptions().data();
}

/// A configuration file that sets only this key and those that the key's section requires.
std::string with(const Key& key, std::string_view value) {
    const bool isList = key.section->kind == OptionSection::Kind::List;
    const std::string head =
        key.section->name.empty()
            ? ""
            : fmt::format("{}{}{}\n", isList ? "[[" : "[", key.section->name, isList ? "]]" : "]");
    std::string needed;
    if (isLevel(key) && key.option->name != "name") needed += "name = \"a\"\n";
    if (isLevel(key) && key.option->name != "ms") needed += "ms = 1.0\n";
    return head + needed + fmt::format("{} = {}\n", key.option->name, value);
}

std::string faults(const Key& key, std::string_view value) {
    if (!isLevel(key)) return test::configFaults(with(key, value));
    try {
        for (const QualityLevel& level : parseQualityLevels(with(key, value), "levels.toml"))
            validate(level.quality);
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

std::string numberText(const Key& key, double value) {
    const Option& option = *key.option;
    std::string one = option.type == OptionType::Whole ? fmt::format("{:.0f}", value)
                                                       : fmt::format("{:.6f}", value);
    if (option.type != OptionType::Numbers) return one;
    std::vector<std::string> all(static_cast<std::size_t>(option.count), one);
    // Only one component of a quaternion may have the largest value.
    if (option.name == "orientation") std::fill(all.begin() + 1, all.end(), "0");
    return fmt::format("[{}]", fmt::join(all, ", "));
}

std::vector<std::string> wordsOf(const Option& option) {
    std::istringstream in{std::string(option.words)};
    return {std::istream_iterator<std::string>(in), {}};
}

std::string another(const Key& key) {
    static const std::map<std::string_view, std::string> texts = {
        {"source", "\"synthetic\""}, {"display", "\"none\""}, {"size", "\"still\""},
        {"environment", "\"sky\""},  {"seed", "7"},           {"format", "\"YUYV\""}};
    const Option& option = *key.option;
    if (option.type == OptionType::Text || option.name == "seed") {
        const auto given = texts.find(option.name);
        return given != texts.end() && key.section->name != "pose" ? given->second : "\"other\"";
    }
    if (option.type == OptionType::Flag) return option.byDefault == "true" ? "false" : "true";
    if (option.type == OptionType::Word)
        for (const std::string& word : wordsOf(option))
            if (const std::string quoted = '"' + word + '"'; quoted != option.byDefault)
                return quoted;
    if (option.type == OptionType::Texts) return "[\"tag16h5\"]";
    if (option.type == OptionType::Values) return "{ gain = 1 }";
    const std::string most = numberText(key, option.range.most);
    return most != option.byDefault ? most : numberText(key, option.range.least);
}

/// All keys of configuration files and of tables of levels. One test covers all, because a test for
/// each would take longer to start than to run.
std::vector<Key> allKeys() {
    std::vector<Key> out = keysOf(configOptions()), levels = keysOf(levelOptions());
    out.insert(out.end(), levels.begin(), levels.end());
    return out;
}

void theParserTakesTheDefault(const Key& key) {
    EXPECT_THAT(faults(key, key.option->byDefault), IsEmpty());
}

TEST(OptionTable, TheParserAcceptsTheDefaultsOfTheTable) {
    for (const Key& key : allKeys()) {
        SCOPED_TRACE(key.name());
        theParserTakesTheDefault(key);
    }
}

void theParserHasTheRange(const Key& key) {
    const OptionRange& range = key.option->range;
    if (range.least == range.most) return;
    EXPECT_THAT(faults(key, numberText(key, range.least)), IsEmpty());
    const bool isTag = key.option->name == "tag";  // the maximum depends on the tag family
    const std::string family = isTag ? "\nfamily = \"tagStandard41h12\"" : "";
    EXPECT_THAT(faults(key, numberText(key, range.most) + family), IsEmpty());
    const double step = key.option->type == OptionType::Whole ? 1 : 1e-6;
    for (const double value : {range.least - step, range.most + step, -1e12, 1e12})
        EXPECT_THAT(faults(key, numberText(key, value) + family),
                    HasSubstr(fmt::format(" from {} to {}", range.least, range.most)))
            << value;
    EXPECT_THAT(describe(*key.option) + "Range: " + rangeText(*key.option),
                HasSubstr(fmt::format("Range: {} to {}", range.least, range.most)));
}

TEST(OptionTable, TheParserEnforcesTheRangesOfTheTable) {
    for (const Key& key : allKeys()) {
        SCOPED_TRACE(key.name());
        theParserHasTheRange(key);
    }
}

void theParserHasTheWords(const Key& key) {
    if (key.option->words.empty()) return;
    const bool isList = key.option->type == OptionType::Texts;
    const auto value = [&](const std::string& word) {
        return fmt::format("{}\"{}\"{}", isList ? "[" : "", word, isList ? "]" : "");
    };
    const std::vector<std::string> words = wordsOf(*key.option);
    for (const std::string& word : words)
        EXPECT_THAT(faults(key, value(word)), IsEmpty());
    // The message about a wrong word must list exactly the words of the table, in any order.
    const std::string refused = faults(key, value("no-such-word"));
    const std::string list = refused.substr(refused.find("one of "));
    EXPECT_EQ(std::ranges::count(list, '"'), 2 * static_cast<std::ptrdiff_t>(words.size()));
    for (const std::string& word : words)
        EXPECT_THAT(list, HasSubstr('"' + word + '"'));
}

TEST(OptionTable, TheParserAcceptsTheWordsOfTheTable) {
    for (const Key& key : allKeys()) {
        SCOPED_TRACE(key.name());
        theParserHasTheWords(key);
    }
}

void onlyReloadableNeedsNoRestart(const Key& key) {
    if (isLevel(key) || key.section->kind != OptionSection::Kind::Always) return;
    std::string text = with(key, another(key));
    if (key.option->name == "format") text += "driver = \"v4l2\"\n";
    const Config changed = parseConfig(text, "test.toml");
    const Config before;
    const std::string restart = needRestart(before, changed);
    if (key.section->isReloadable) {
        EXPECT_EQ(restart, "");
        EXPECT_TRUE(changed.superres != before.superres || changed.trigger != before.trigger ||
                    changed.status != before.status ||
                    changed.light.source != before.light.source ||
                    changed.light.exposure != before.light.exposure)
            << "the value has no effect";
    } else {
        EXPECT_EQ(restart, key.section->name.empty()
                               ? key.option->name
                               : key.section->name.substr(0, key.section->name.find('.')));
    }
}

TEST(OptionTable, OnlyReloadableOptionsNeedNoRestart) {
    for (const Key& key : allKeys()) {
        SCOPED_TRACE(key.name());
        onlyReloadableNeedsNoRestart(key);
    }
}

std::string section(std::string_view name, std::span<const OptionSection> table) {
    const auto found = std::ranges::find(table, name, &OptionSection::name);
    std::string out = fmt::format("[[{}]]\n", name);
    for (const Option& option : found->options)
        if (!option.isAbsent) out += fmt::format("{} = {}\n", option.name, option.byDefault);
    return out;
}

TEST(OptionDefaults, ObjectDefaultsMatchTheParser) {
    const auto read = [](const std::string& text) {
        return parseConfig(text, "test.toml").objects.at(0);
    };
    const PlacedObject without = read("[[objects]]\n");
    const PlacedObject given = read(section("objects", configOptions()));
    EXPECT_EQ(given.scale, without.scale);
    EXPECT_EQ(given.shape.shape, without.shape.shape);
    EXPECT_EQ(given.shape.size, without.shape.size);
    EXPECT_EQ(given.shape.squares, without.shape.squares);
    EXPECT_EQ(given.T_anchor_object.translation, without.T_anchor_object.translation);
    EXPECT_TRUE(given.T_anchor_object.rotation.isApprox(without.T_anchor_object.rotation));
    EXPECT_FALSE(given.tag);
    const PlacedObject onTag = read("[[objects]]\ntag = 0\n");
    EXPECT_EQ(read(section("objects", configOptions()) + "tag = 0\n").tag, onTag.tag);
    // Without keys for the colours, the parser uses the colours that the table shows.
    const PlacedObject coloured =
        read("[[objects]]\ncolour = [0.9, 0.9, 0.9]\nsecond_colour = [0.8, 0.2, 0.1]\n");
    EXPECT_EQ(coloured.shape.colours, without.shape.colours);
}

TEST(OptionDefaults, SunDefaultsMatchTheParser) {
    const Sun byDefault;
    std::string text = "[light.sun]\n";
    for (const Key& key : keysOf(configOptions()))
        if (key.section->name == "light.sun")
            text += fmt::format("{} = {}\n", key.option->name, key.option->byDefault);
    const Sun given = parseConfig(text, "test.toml").light.sun.value();
    EXPECT_TRUE(given.towards.isApprox(byDefault.towards.normalized(), 1e-3F));
    EXPECT_EQ(given.irradiance, byDefault.irradiance);
    EXPECT_NEAR(given.angularRadius, byDefault.angularRadius, 1e-5F);
}

TEST(OptionDefaults, QualityLevelDefaultsMatchTheParser) {
    const std::string text = section("level", levelOptions()) + "name = \"a\"\nms = 1\n";
    const auto levels = parseQualityLevels(text, "levels.toml");
    EXPECT_EQ(levels.at(0).quality, Quality{});
    EXPECT_EQ(levels.at(0).psnrDb, QualityLevel{}.psnrDb);
}

TEST(OptionDefaults, TheHelpTextOfSourceNamesEverySceneAndCameraPath) {
    const std::string about = describe(overriddenBy("--source"));
    for (const auto& [wrong, start] :
         {std::pair("synthetic:attic", "SCENE is one of: "),
          std::pair("synthetic:office,jump", "PATH is the camera's motion: ")}) {
        const std::string fault = sourceFault(wrong).value();
        EXPECT_THAT(about, HasSubstr(start + fault.substr(fault.find("one of ") + 7) + "."));
    }
}

TEST(OptionText, TheDefaultFileHasEveryKeyAndNoLineOfMoreThan100Characters) {
    const std::string text = defaultConfigText();
    for (const OptionSection& section : configOptions()) {
        if (!section.name.empty()) {
            EXPECT_THAT(text, HasSubstr(fmt::format("[{}]", section.name)));
        }
        for (const Option& option : section.options)
            EXPECT_THAT(text, HasSubstr(fmt::format("{} = {}\n", option.name, option.byDefault)));
    }
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        EXPECT_LE(line.size(), 100U) << line;
}

TEST(OptionText, CommentedOutSectionsAreValidOnceUncommented) {
    std::string text = defaultConfigText(), all;
    std::istringstream in(text.substr(text.find("# [light.sun]")));
    for (std::string line; std::getline(in, line);)
        all += line.substr(std::min<std::size_t>(line.size(), 2)) + "\n";
    EXPECT_THAT(test::configFaults(all), IsEmpty()) << all;
    EXPECT_THAT(all, AllOf(HasSubstr("\n[[objects]]"), Not(HasSubstr("\n\n\n"))));
}

}  // namespace
}  // namespace mfar
