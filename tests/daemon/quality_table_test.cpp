#include "daemon/config.h"
#include "daemon/quality_table.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

TEST(QualityTable, BuiltInLevelsFormAParetoFront) {
    const auto& levels = builtInQualityLevels();
    ASSERT_GE(levels.size(), 3U);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_GT(levels[i].ms, levels[i - 1].ms) << levels[i].name;
        EXPECT_GT(levels[i].psnrDb, levels[i - 1].psnrDb) << levels[i].name;
    }
    EXPECT_EQ(levels.front().quality.mode, SuperResMode::Off);
    for (const QualityLevel& level : levels)
        EXPECT_NO_THROW(validate(level.quality)) << level.name;
}

TEST(QualityTable, WrittenTablesAreReadBack) {
    Quality fast;
    fast.mode = SuperResMode::Blend;
    fast.alongLines = false;
    fast.learned = false;
    fast.cubic = false;
    fast.depthEvery = 3;
    fast.flow2d = {.searchRadius = 1,
                   .candidates = 2,
                   .steps = 3,
                   .propagations = 4,
                   .coarsestPropagations = 5,
                   .planeFits = 1};
    fast.epipolar = {
        .windowRadius = 1, .stepPenalty = 2, .jumpPenalty = 3, .finest = 2, .mostPredicted = 4};
    fast.detailShare = 0.125;
    fast.secondShare = 0.5;
    const std::vector<QualityLevel> levels{{"slow", 20, 30, {}}, {"fast", 10.5, 25.25, fast}};
    const auto read = parseQualityLevels(toToml(levels), "file");
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].name, "fast") << "levels must be sorted by increasing time";
    EXPECT_EQ(read[0].ms, 10.5);
    EXPECT_EQ(read[0].psnrDb, 25.25);
    EXPECT_EQ(read[0].quality, fast);
    EXPECT_EQ(read[1].quality, Quality{});
}

std::string faultOf(const std::string& toml) {
    try {
        (void)parseQualityLevels(toml, "file");
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(QualityTable, FaultsAreReportedWithLineAndColumn) {
    const std::string level = "[[level]]\nname = \"a\"\nms = 1\n";
    EXPECT_EQ(faultOf(level), "");
    EXPECT_EQ(faultOf(""), "file:1:1: the table of levels has no section [[level]]");
    EXPECT_EQ(faultOf("[[level]]\nms = 1\n"), "file:1:1: level[0] needs the keys name and ms");
    EXPECT_EQ(faultOf(level + level), "file:1:1: level \"a\" occurs twice");
    EXPECT_EQ(faultOf(level + "flow2d.steps = 17\n").substr(0, 9), "file:4:16");
    EXPECT_EQ(faultOf(level + "ms2 = 1\n").substr(0, 8), "file:4:1");
    EXPECT_EQ(faultOf("[[level]]\nname = \"a\"\nms = nan\n").substr(0, 8), "file:3:6");
    EXPECT_EQ(faultOf(level + "brightness = 1\n"),
              "file:4:1: unknown key level[0].brightness; docs/configuration.md lists all known "
              "ones");
}

TEST(QualityTable, LevelsAboveTheRequestedSuperResolutionModeAreRemoved) {
    const std::vector<QualityLevel> levels{
        {"linear", 5, 19, {.mode = SuperResMode::Off, .cubic = false}},
        {"off", 10, 20, {.mode = SuperResMode::Off}},
        {"blend", 20, 22, {.mode = SuperResMode::Blend}},
        {"detail", 30, 25, {}}};
    EXPECT_EQ(limitedTo(levels, SuperResMode::Detail).size(), 4U);
    const auto blend = limitedTo(levels, SuperResMode::Blend);
    ASSERT_EQ(blend.size(), 3U);
    EXPECT_EQ(blend[2].name, "blend");
    const auto off = limitedTo(levels, SuperResMode::Off);
    ASSERT_EQ(off.size(), 2U);
    EXPECT_EQ(off[0].name, "linear");
    EXPECT_EQ(off[1].name, "off");
}

TEST(QualityTable, ANameWithQuotesAndAShortTimeAreReadBack) {
    std::vector<QualityLevel> levels(1);
    levels[0].name = "a\"b\\c\n\t'";
    levels[0].ms = 0.002;
    const auto read = parseQualityLevels(toToml(levels), "file");
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].name, levels[0].name);
    EXPECT_EQ(read[0].ms, levels[0].ms);
}

}  // namespace
}  // namespace mfar
