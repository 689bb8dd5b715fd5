#include "daemon/config.h"
#include "daemon/exit_code.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// All faults of a text, one line each; empty when it is good.
std::string faults(std::string_view toml) {
    try {
        (void)parseConfig(toml, "test.toml");
        return "";
    } catch (const ConfigError& error) {
        return error.what();
    }
}

void expectSame(const Config& a, const Config& b) {
    EXPECT_EQ(needRestart(a, b), "");
    EXPECT_EQ(a.superres, b.superres);
    EXPECT_EQ(a.trigger, b.trigger);
    EXPECT_EQ(a.status, b.status);
}

TEST(Config, EmptyTextGivesTheDefaults) {
    expectSame(parseConfig("", "test.toml"), Config{});
}

TEST(Config, TheDefaultFileShowsTheDefaults) {
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
    EXPECT_EQ(config.recordTo, "/data/new");
    EXPECT_EQ(config.status, (StatusConfig{0.5, true}));
}

TEST(Config, SyntaxErrorsHaveAPlace) {
    EXPECT_THAT(faults("seed = 1\nseed = = 2\n"), StartsWith("test.toml:2:"));
}

TEST(Config, UnknownKeysAreRefusedWithTheNearestKnownOne) {
    EXPECT_EQ(faults("[trigger]\nmin_intervall_s = 1\n"),
              "test.toml:2:1: unknown key trigger.min_intervall_s; the nearest known one is "
              "trigger.min_interval_s");
}

TEST(Config, AKeyInTheWrongSectionPointsToTheRightOne) {
    EXPECT_THAT(faults("rate_hz = 3\n"), HasSubstr("trigger.rate_hz"));
    EXPECT_THAT(faults("[status]\nskip_unchanged = true\n"), HasSubstr("superres.skip_unchanged"));
}

TEST(Config, UnknownSectionsAreRefused) {
    EXPECT_THAT(faults("[trigggr]\n"), AllOf(StartsWith("test.toml:1:"), HasSubstr("trigggr")));
    EXPECT_THAT(faults("trigger = 3\n"), HasSubstr("must be a section"));
}

TEST(Config, WrongTypesAreRefused) {
    EXPECT_EQ(faults("pace = 3\n"),
              "test.toml:1:8: pace must be a text in quotes, not a whole number");
    EXPECT_THAT(faults("seed = 1.5\n"), HasSubstr("whole number"));
    EXPECT_THAT(faults("[superres]\nskip_unchanged = 1\n"), HasSubstr("true or false"));
    EXPECT_THAT(faults("[trigger]\nrate_hz = \"fast\"\n"), HasSubstr("must be a number"));
    EXPECT_THAT(faults("[trigger]\nrate_hz = [1]\n"), HasSubstr("not a list"));
}

TEST(Config, RangesAreHeld) {
    EXPECT_THAT(faults("seed = -1\n"), HasSubstr("negative"));
    for (const char* value : {"0.0", "-1", "61", "nan", "inf", "-inf", "1e300"})
        EXPECT_THAT(faults(std::string("[trigger]\nrate_hz = ") + value + "\n"),
                    StartsWith("test.toml:2:11: trigger.rate_hz must be from 0.01 to 60"))
            << value;
    EXPECT_THAT(faults("[trigger]\nexplained_below = 1.01\n"), HasSubstr("from 0 to 1"));
    EXPECT_THAT(faults("[status]\ninterval_s = 0\n"), HasSubstr("from 0.1 to 3600"));
}

TEST(Config, UnknownWordsSayWhichExist) {
    EXPECT_THAT(faults("[superres]\nmode = \"best\"\n"),
                AllOf(StartsWith("test.toml:2:8: "), HasSubstr("detail"), HasSubstr("blend")));
    EXPECT_THAT(faults("source = \"libcamera\"\n"), HasSubstr("synthetic"));
    EXPECT_THAT(faults("source = \"synthetic:attic\"\n"), HasSubstr("office"));
    EXPECT_THAT(faults("source = \"synthetic:office,jump\"\n"), HasSubstr("orbit"));
    EXPECT_THAT(faults("display = \"jpg:x\"\n"), HasSubstr("png:"));
    EXPECT_THAT(faults("display = \"png:\"\n"), HasSubstr("png:"));
}

TEST(Config, EveryFaultIsSaidInFileOrder) {
    const std::string all = faults("colour = 1\nseed = -3\n[trigger]\nrate_hz = 99\nzoom = 1\n");
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

TEST(Config, AFileThatCannotBeReadIsAMissingInput) {
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

TEST(Config, NeedRestartNamesWhatCannotChangeWhileRunning) {
    Config wanted;
    wanted.superres.mode = SuperResMode::Off;
    wanted.trigger.maxAgeS = 1;
    wanted.status.intervalS = 2;
    EXPECT_EQ(needRestart(Config{}, wanted), "");
    wanted.display = "png:x";
    wanted.seed = 3;
    EXPECT_EQ(needRestart(Config{}, wanted), "display, seed");
}

}  // namespace
}  // namespace mfar
