#include "daemon/exit_code.h"
#include "daemon/options.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <gmock/gmock.h>
#include <vector>

namespace mfar {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CommandLine parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "mfard");
    return parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

std::string usageFault(std::vector<const char*> arguments) {
    try {
        (void)parse(std::move(arguments));
        return "";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code, ExitCode::Usage);
        return failure.what();
    }
}

TEST(Options, WithoutArgumentsAllOptionsHaveTheirDefaults) {
    const CommandLine line = parse({});
    EXPECT_FALSE(line.print);
    const Config config = effectiveConfig(line.options);
    EXPECT_EQ(needRestart(config, Config{}), "");
    EXPECT_FALSE(line.options.frames || line.options.seconds || line.options.summary);
}

TEST(Options, EveryOptionIsRead) {
    const Options options =
        parse({"--recording", "/data/run", "--display",  "png:out",   "--record",
               "new",         "--mode",    "blend",      "--pace",    "consumer",
               "--seed",      "7",         "--frames",   "12",        "--seconds",
               "2.5",         "--summary", "-",          "--measure", "--check-config",
               "--pose",      "recorded",  "--validate", "--report",  "run.html"})
            .options;
    EXPECT_TRUE(options.checkConfig);
    EXPECT_EQ(options.frames, 12U);
    EXPECT_EQ(options.seconds, 2.5);
    EXPECT_EQ(options.summary, "-");
    EXPECT_EQ(options.report, "run.html");
    const Config config = effectiveConfig(options);
    EXPECT_EQ(config.recording, "/data/run");
    EXPECT_EQ(config.display, "png:out");
    EXPECT_EQ(config.recordTo, "new");
    EXPECT_EQ(config.superres.mode, SuperResMode::Blend);
    EXPECT_EQ(config.pace, SourcePace::Consumer);
    EXPECT_EQ(config.pose.source, PoseOrigin::Recorded);
    EXPECT_EQ(config.seed, 7U);
    EXPECT_TRUE(config.status.measure);
    EXPECT_TRUE(config.validate);
}

TEST(Options, TheCommandLineOverridesTheFile) {
    const test::TempFolder folder;
    const std::string file = (folder.path() / "mfard.toml").string();
    std::ofstream(file) << "recording = \"/data/run\"\nseed = 5\n[superres]\nmode = \"off\"\n";
    const Config fromFile = effectiveConfig(parse({"--config", file.c_str()}).options);
    EXPECT_EQ(fromFile.recording, "/data/run");
    EXPECT_EQ(fromFile.superres.mode, SuperResMode::Off);
    const Config both = effectiveConfig(
        parse({"--config", file.c_str(), "--source", "synthetic:flat", "--mode", "detail"})
            .options);
    EXPECT_EQ(both.source, "synthetic:flat");
    EXPECT_EQ(both.recording, "") << "--source must replace the file's recording";
    EXPECT_EQ(both.superres.mode, SuperResMode::Detail);
    EXPECT_EQ(both.seed, 5U);
}

TEST(Options, UsageErrorsListTheValidChoices) {
    EXPECT_THAT(usageFault({"--source", "webcam"}), HasSubstr("synthetic"));
    EXPECT_THAT(usageFault({"--display", "screen"}), AllOf(HasSubstr("none"), HasSubstr("y4m")));
    EXPECT_THAT(usageFault({"--mode", "best"}), HasSubstr("detail"));
    EXPECT_THAT(usageFault({"--pace", "slow"}), HasSubstr("consumer"));
    for (const char* wrong : {"0", "-3", "x", "1.5", "99999999999999999999"})
        EXPECT_THAT(usageFault({"--frames", wrong}),
                    AllOf(HasSubstr("--frames"), HasSubstr(wrong), HasSubstr("at least 1")));
    // CLI11 would read them as octal numbers.
    EXPECT_THAT(usageFault({"--frames", "010"}), HasSubstr("\"010\" has a leading zero"));
    EXPECT_THAT(usageFault({"--seed", "010"}), HasSubstr("010 has a leading zero"));
    EXPECT_EQ(parse({"--seed", "0"}).options.seed, 0U);
    EXPECT_THAT(usageFault({"--seconds", "nan"}), HasSubstr("--seconds"));
    EXPECT_THAT(usageFault({"--seed", "x"}), HasSubstr("--seed"));
    EXPECT_THAT(usageFault({"--seed", "-1"}), HasSubstr("--seed"));
    EXPECT_THAT(usageFault({"--seed", "18446744073709551616"}),
                AllOf(HasSubstr("--seed"), HasSubstr("exceeds 2^64 - 1")));
    EXPECT_EQ(parse({"--seed", "18446744073709551615"}).options.seed, ~std::uint64_t{0});
    EXPECT_THAT(usageFault({"--report", "-"}), HasSubstr("name a file"));
    EXPECT_THAT(usageFault({"--colour"}), HasSubstr("--colour"));
    EXPECT_THAT(usageFault({"--source", "synthetic", "--recording", "x"}),
                HasSubstr("--recording"));
}

TEST(Options, HelpAndVersionArePrinted) {
    EXPECT_THAT(parse({"--help"}).print.value_or(""),
                AllOf(HasSubstr("--recording"), HasSubstr("office"), HasSubstr("handheld")));
    EXPECT_THAT(parse({"--version"}).print.value_or(""), HasSubstr("mfard " MFAR_VERSION));
}

}  // namespace
}  // namespace mfar
