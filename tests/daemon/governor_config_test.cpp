#include "daemon/config.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

TEST(GovernorConfig, EveryKeyIsReadAndChecked) {
    const GovernorConfig read =
        parseConfig("[governor]\ndeadline_ms = 33.5\npin = \"off\"\ntable = \"levels.toml\"\n",
                    "/etc/mfar/test.toml")
            .governor;
    EXPECT_EQ(read.deadlineMs, 33.5);
    EXPECT_EQ(read.pin, "off");
    EXPECT_EQ(read.table, "/etc/mfar/levels.toml");
    for (const char* wrong : {"-1", "nan", "10001", "\"33\""})
        EXPECT_THROW((void)parseConfig(std::string("[governor]\ndeadline_ms = ") + wrong, "t"),
                     ConfigError)
            << wrong;
    Config wanted;
    wanted.governor.deadlineMs = 33;
    EXPECT_EQ(needRestart(Config{}, wanted), "governor");
}

TEST(GovernorConfig, WithoutADeadlineOrAPinnedLevelThereIsNoGovernor) {
    EXPECT_TRUE(governedLevels({}).empty());
    EXPECT_FALSE(GovernorConfig{}.governs());
    EXPECT_EQ(governedLevels({33, "", ""}).size(), builtInQualityLevels().size());
}

TEST(GovernorConfig, APinnedLevelIsTheOnlyLevelAndHasNoGovernor) {
    const GovernorConfig pinned{33, "off", ""};
    EXPECT_FALSE(pinned.governs());
    const auto levels = governedLevels(pinned);
    ASSERT_EQ(levels.size(), 1U);
    EXPECT_EQ(levels[0].quality.mode, SuperResMode::Off);
    EXPECT_THROW((void)governedLevels({0, "nowhere", ""}), ConfigError);
}

TEST(GovernorConfig, LevelsComeFromTheConfiguredTable) {
    const test::TempFolder folder;
    test::writeFile(folder / "levels.toml",
                    "[[level]]\nname = \"b\"\nms = 2\n[[level]]\nname = \"a\"\nms = 1\n");
    const auto levels = governedLevels({33, "", folder / "levels.toml"});
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].name, "a");
    EXPECT_THROW((void)governedLevels({33, "", folder / "absent"}), Failure);
}

}  // namespace
}  // namespace mfar
