#include "daemon/config.h"
#include "daemon/exit_code.h"
#include "tests/daemon/config_faults.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <gmock/gmock.h>

namespace mfar {
namespace {

using test::configFaults;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

void expectSame(const Config& a, const Config& b) {
    EXPECT_EQ(needRestart(a, b), "");
    EXPECT_EQ(a.superres, b.superres);
    EXPECT_EQ(a.trigger, b.trigger);
    EXPECT_EQ(a.pose, b.pose);
    EXPECT_EQ(a.cameras, b.cameras);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.virtualLayer, b.virtualLayer);
    EXPECT_EQ(a.light.source, b.light.source);
    EXPECT_EQ(a.light.exposure, b.light.exposure);
    EXPECT_EQ(a.light.sun.has_value(), b.light.sun.has_value());
}

TEST(Config, AnEmptyConfigurationGivesTheDefaults) {
    expectSame(parseConfig("", "test.toml"), Config{});
}

TEST(Config, TheDefaultConfigurationFileContainsTheDefaults) {
    expectSame(loadConfig(MFAR_DEFAULT_CONFIG), Config{});
}

TEST(Config, EveryKeyIsRead) {
    const Config config = parseConfig(R"(
source = "synthetic:shelf,pan"
recording = "/data/run"
display = "png:/tmp/out"
pace = "consumer"
seed = 42
[superres]
mode = "blend"
skip_unchanged = false
[trigger]
mode = "rate"
rate_hz = 4
explained_below = 0.25
max_age_s = 3.5
min_interval_s = 1
timeout_s = 0.5
[pose]
source = "recorded"
tags = "/data/tags.toml"
families = ["tag25h9", "tag16h5", "tag25h9"]
tag_size = 0.05
decimation = 1.5
threads = 2
full_search_interval = 30
bridge_frames = 0
[record]
directory = "/data/new"
[status]
interval_s = 0.5
measure = true
)",
                                      "test.toml");
    EXPECT_EQ(config.source, "synthetic:shelf,pan");
    EXPECT_EQ(config.recording, "/data/run");
    EXPECT_EQ(config.display, "png:/tmp/out");
    EXPECT_EQ(config.pace, SourcePace::Consumer);
    EXPECT_EQ(config.seed, 42U);
    EXPECT_EQ(config.superres, (SuperResConfig{SuperResMode::Blend, false}));
    EXPECT_EQ(config.trigger, (TriggerConfig{TriggerMode::Rate, 4, 0.25, 3.5, 1, 0.5}));
    PoseConfig pose{PoseOrigin::Recorded, "/data/tags.toml"};
    pose.families = {TagFamily::Tag25h9, TagFamily::Tag16h5};
    pose.tagSize = 0.05;
    pose.decimation = 1.5;
    pose.threads = 2;
    pose.fullSearchInterval = 30;
    pose.bridgeFrames = 0;
    EXPECT_EQ(config.pose, pose);
    EXPECT_EQ(config.record.directory, "/data/new");
    EXPECT_EQ(config.status, (StatusConfig{0.5, true}));
}

TEST(Config, SyntaxErrorsAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("seed = 1\nseed = = 2\n"), StartsWith("test.toml:2:"));
}

TEST(Config, AnUnknownKeyIsRefusedWithTheNearestKnownKey) {
    EXPECT_EQ(configFaults("[trigger]\nmin_intervall_s = 1\n"),
              "test.toml:2:1: unknown key trigger.min_intervall_s; the nearest known one is "
              "trigger.min_interval_s");
}

TEST(Config, ANameInQuotesThatContainsADotIsRefused) {
    EXPECT_EQ(configFaults("[\"cameras.trigger\"]\nline = \"GPIO17\"\n"),
              "test.toml:1:2: unknown key \"cameras.trigger\"; write names without quotes");
    EXPECT_EQ(configFaults("\"superres.mode\" = \"off\"\n"),
              "test.toml:1:1: unknown key \"superres.mode\"; write names without quotes");
    EXPECT_EQ(configFaults("[\"superres\"]\n\"mode\" = \"off\"\n"), "");
}

TEST(Config, NoKeyIsSuggestedIfNoneIsSimilar) {
    EXPECT_EQ(configFaults("[light.sun]\nintensity = 3\n"),
              "test.toml:2:1: unknown key light.sun.intensity; mfard --print-config lists all "
              "known ones");
}

TEST(Config, AKeyInTheWrongSectionIsReportedWithTheRightSection) {
    EXPECT_THAT(configFaults("explained_below = 3\n"), HasSubstr("trigger.explained_below"));
    EXPECT_THAT(configFaults("[status]\nskip_unchanged = true\n"),
                HasSubstr("superres.skip_unchanged"));
}

TEST(Config, UnknownSectionsAreRefused) {
    EXPECT_EQ(configFaults("[trigggr]\n"),
              "test.toml:1:2: unknown section [trigggr]; the nearest known one is [trigger]");
    EXPECT_EQ(configFaults("[camera.video]\nwidth = 640\n"),
              "test.toml:1:2: unknown section [camera]; the nearest known one is [cameras]");
    EXPECT_EQ(configFaults("[cameras.vidio]\nwidth = 640\n"),
              "test.toml:1:10: unknown section [cameras.vidio]; the nearest known one is "
              "[cameras.video]");
    EXPECT_THAT(configFaults("trigger = 3\n"), HasSubstr("must be a section"));
}

TEST(Config, WrongTypesAreRefused) {
    EXPECT_EQ(configFaults("pace = 3\n"),
              "test.toml:1:8: pace must be a text in quotes, not a whole number");
    EXPECT_THAT(configFaults("seed = 1.5\n"), HasSubstr("whole number"));
    EXPECT_THAT(configFaults("[superres]\nskip_unchanged = 1\n"), HasSubstr("true or false"));
    EXPECT_THAT(configFaults("[trigger]\nrate_hz = \"fast\"\n"), HasSubstr("must be a number"));
    EXPECT_THAT(configFaults("[trigger]\nrate_hz = [1]\n"), HasSubstr("not a list"));
}

TEST(Config, ValuesOutOfRangeAreRefused) {
    EXPECT_THAT(configFaults("seed = -1\n"), HasSubstr("negative"));
    for (const char* value : {"0.0", "-1", "61", "nan", "inf", "-inf", "1e300"})
        EXPECT_THAT(configFaults(std::string("[trigger]\nrate_hz = ") + value + "\n"),
                    StartsWith("test.toml:2:11: trigger.rate_hz must be from 0.01 to 60"))
            << value;
    EXPECT_THAT(configFaults("[trigger]\nexplained_below = 1.01\n"), HasSubstr("from 0 to 1"));
    EXPECT_THAT(configFaults("[status]\ninterval_s = 0\n"), HasSubstr("from 0.1 to 3600"));
}

TEST(Config, AnUnknownWordIsReportedWithTheValidWords) {
    EXPECT_THAT(configFaults("[superres]\nmode = \"best\"\n"),
                AllOf(StartsWith("test.toml:2:8: "), HasSubstr("detail"), HasSubstr("blend")));
    EXPECT_THAT(configFaults("source = \"libcamera\"\n"),
                AllOf(HasSubstr("cameras"), HasSubstr("synthetic")));
    EXPECT_THAT(configFaults("display = \"kms:card0,1280y720\"\n"), HasSubstr("1280y720"));
    EXPECT_THAT(configFaults("source = \"synthetic:attic\"\n"), HasSubstr("office"));
    EXPECT_THAT(configFaults("source = \"synthetic:office,jump\"\n"), HasSubstr("orbit"));
    EXPECT_THAT(configFaults("display = \"jpg:x\"\n"), HasSubstr("png:"));
    EXPECT_THAT(configFaults("display = \"png:\"\n"), HasSubstr("png:"));
}

TEST(Config, FaultsAreReportedInFileOrder) {
    const std::string all =
        configFaults("colour = 1\nseed = -3\n[trigger]\nrate_hz = 99\nzoom = 1\n");
    std::vector<std::string> lines;
    std::istringstream in(all);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    ASSERT_EQ(lines.size(), 4U) << all;
    EXPECT_THAT(lines[0], StartsWith("test.toml:1:1: unknown key colour"));
    EXPECT_THAT(lines[1], StartsWith("test.toml:2:8: seed"));
    EXPECT_THAT(lines[2], StartsWith("test.toml:4:11: trigger.rate_hz"));
    EXPECT_THAT(lines[3], StartsWith("test.toml:5:1: unknown key trigger.zoom"));
}

TEST(Config, AnUnreadableFileGivesTheExitCodeOfAMissingInput) {
    for (const char* file : {"/nonexistent/mfard.toml", "/"}) {
        try {
            (void)loadConfig(file);
            FAIL() << file;
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code, ExitCode::NoInput);
            EXPECT_THAT(failure.what(), StartsWith(file));
        }
    }
}

TEST(Config, TextsWithTooDeepNestingOrTooManyValuesAreRefused) {
    std::string dots = "seed";
    for (int i = 0; i < 50'000; ++i)
        dots += ".a";
    EXPECT_EQ(configFaults(dots + " = 1\n"), "test.toml:1:67: a key has more than 32 parts");
    EXPECT_EQ(configFaults("pace = \"auto\"\n[" + dots + "]\n"),
              "test.toml:2:68: a key has more than 32 parts");
    // Quotes in front of a dotted key must not hide the key from the check. Dots in a comment or in
    // a quoted text must not count as nesting.
    EXPECT_THAT(configFaults("a = [\"\"\"x\"\"\"\", {" + dots + " = 1}]\n"), HasSubstr("32 parts"));
    EXPECT_THAT(configFaults("a = ['''x'''', {" + dots + " = 1}]\n"), HasSubstr("32 parts"));
    EXPECT_EQ(configFaults("# " + dots + "\nrecording = \"" + dots + "\"\n"), "");
    EXPECT_EQ(configFaults("a = " + std::string(50'000, '[')),
              "test.toml:1:37: brackets are nested more than 32 levels deep");
    EXPECT_THAT(configFaults("a = " + std::string(50'000, '{')), HasSubstr("more than 32 levels"));
    std::string list = "a = [0";
    for (int i = 0; i < 100'000; ++i)
        list += ",0";
    EXPECT_THAT(configFaults(list + "]"), HasSubstr("more than 100000 values"));
    // Each part of a dotted key is a table and counts as a value.
    std::string tables;
    for (int i = 0; i < 4'000; ++i)
        tables += fmt::format("a{}.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b.b = 1\n", i);
    EXPECT_THAT(configFaults(tables), HasSubstr("more than 100000 values"));
}

TEST(Config, TheNumberOfReportedFaultsIsLimited) {
    std::string text;
    for (int i = 0; i < 5'000; ++i)
        text += "x" + std::to_string(i) + " = 1\n";
    const std::string said = configFaults(text + std::string(100'000, 'y') + " = 1\n");
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 50);
    EXPECT_THAT(said, HasSubstr("more faults may follow"));
    EXPECT_THAT(configFaults(std::string(100'000, 'y') + " = 1\n"),
                HasSubstr("unknown key of 100000 characters"));
}

TEST(Config, TooLargeIntegersAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("[trigger]\nrate_hz = 9007199254740993\n"),
                StartsWith("test.toml:2:11: trigger.rate_hz must be from 0.01 to 60, not "));
    EXPECT_THAT(configFaults("[[objects]]\norientation = [9223372036854775807, 0, 0, 0]\n"),
                StartsWith("test.toml:2:16: objects[0].orientation must hold numbers"));
}

TEST(Config, DevicesAndPipesAreRefused) {
    const test::TempFolder folder;
    const std::filesystem::path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    test::writeFile(folder / "long", std::string(2 << 20, '#'));
    const std::pair<std::filesystem::path, const char*> files[] = {
        {pipe, "it is not a regular file"},
        {"/dev/zero", "it is not a regular file"},
        {"/dev/full", "it is not a regular file"},
        // The kernel reports a size of 0 for this file.
        {"/proc/version", "it became longer while it was read"},
        {folder / "long", "it has 2097152 bytes; the limit is 1048576 bytes"},
    };
    for (const auto& [file, what] : files) {
        try {
            (void)loadConfig(file);
            FAIL() << file;
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.what(), file.string() + ": cannot be read: " + what);
        }
    }
}

TEST(Config, RecordingsAreRelativeToTheConfiguration) {
    const char* text = "recording = \"walk\"\n";
    EXPECT_EQ(parseConfig(text, "/etc/mfar/mfard.toml").recording, "/etc/mfar/walk");
    EXPECT_EQ(parseConfig("recording = \"/data/walk\"\n", "/etc/mfar/mfard.toml").recording,
              "/data/walk");
    EXPECT_EQ(parseConfig("", "/etc/mfar/mfard.toml").recording, "") << "there is no recording";
}

TEST(Config, TagMapPathsAreRelativeToTheConfiguration) {
    const char* text = "[pose]\ntags = \"maps/tags.toml\"\n";
    EXPECT_EQ(parseConfig(text, "/etc/mfar/mfard.toml").pose.tags, "/etc/mfar/maps/tags.toml");
    EXPECT_EQ(parseConfig(text, "mfard.toml").pose.tags, "maps/tags.toml");
    EXPECT_EQ(parseConfig("", "/etc/mfar/mfard.toml").pose.tags, "") << "no tag map is configured";
}

TEST(Config, EveryPoseKeyIsChecked) {
    const std::pair<const char*, const char*> wrong[] = {
        {"source = \"gps\"", "2:10: pose.source = \"gps\": must be one of \"tags\", \"recorded\""},
        {"tags = 3", "2:8: pose.tags must be a text"},
        {"families = \"tag36h11\"", "2:12: pose.families must be a list of texts"},
        {"families = []", "2:12: pose.families must be a list of texts in quotes, not an empty"},
        {"families = [\"tag36h11\", 4]", "2:25: pose.families must be a list of texts"},
        {"families = [\"tag36h10\"]", "2:13: pose.families \"tag36h10\": must be one of"},
        {"tag_size = 0.0", "2:12: pose.tag_size must be from 0.001 to 100"},
        {"tag_size = nan", "2:12: pose.tag_size must be from 0.001 to 100"},
        {"decimation = 2.5", "2:14: pose.decimation = 2.5: must be 1.5 or a whole number"},
        {"decimation = 9", "2:14: pose.decimation must be from 1 to 8"},
        {"threads = 0", "2:11: pose.threads must be from 1 to 64"},
        {"threads = 1.5", "2:11: pose.threads must be a whole number"},
        {"full_search_interval = 0", "2:24: pose.full_search_interval must be from 1"},
        {"bridge_frames = -1", "2:17: pose.bridge_frames must be from 0 to 300"},
        {"tag_sise = 1", "2:1: unknown key pose.tag_sise; the nearest known one is pose.tag_size"},
    };
    for (const auto& [line, message] : wrong)
        EXPECT_THAT(configFaults(std::string("[pose]\n") + line + "\n"),
                    StartsWith(std::string("test.toml:") + message))
            << line;
}

TEST(Config, ChangedKeysThatNeedARestartAreListed) {
    Config wanted;
    wanted.superres.mode = SuperResMode::Off;
    wanted.trigger.maxAgeS = 1;
    wanted.status.intervalS = 2;
    EXPECT_EQ(needRestart(Config{}, wanted), "");
    wanted.display = "png:x";
    wanted.seed = 3;
    wanted.pose.threads = 2;
    EXPECT_EQ(needRestart(Config{}, wanted), "display, seed, pose");
}

}  // namespace
}  // namespace mfar
