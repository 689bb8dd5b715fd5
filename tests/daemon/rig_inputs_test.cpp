#include "daemon/options.h"
#include "daemon/rig_inputs.h"
#include "tests/unit/small_recording.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace mfar {
namespace {

struct Refusal {
    int code = 0;
    std::string message{};
    bool operator==(const Refusal&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
    return out << refusal.code << ": " << refusal.message;
}

class RigInputs : public testing::Test {
protected:
    /// Returns the refusal of a configuration file, with FOLDER instead of the folder's path.
    Refusal refusal(const std::string& toml, Options options = {}) {
        test::writeFile(folder_ / "mfard.toml", toml);
        options.config = folder_ / "mfard.toml";
        try {
            (void)usableConfig(options);
            return {};
        } catch (const Failure& failure) {
            std::string message = failure.what();
            const std::string path = folder_.path().string();
            for (std::size_t at = 0; (at = message.find(path)) != message.npos;)
                message.replace(at, path.size(), "FOLDER");
            return {static_cast<int>(failure.code), message};
        }
    }
    test::TempFolder folder_;
};

TEST_F(RigInputs, AMissingOrInvalidCalibrationIsReportedWithItsKey) {
    const std::string toml = "[cameras]\ncalibration = \"lens.yaml\"\n";
    EXPECT_EQ(refusal(toml),
              (Refusal{66, "FOLDER/mfard.toml:2:15: cameras.calibration: FOLDER/lens.yaml: is "
                           "missing"}));
    test::writeFile(folder_ / "lens.yaml", "a: 1\nb: [\n");
    const Refusal invalid = refusal(toml);
    EXPECT_EQ(invalid.code, 65);
    EXPECT_TRUE(invalid.message.starts_with(
        "FOLDER/mfard.toml:2:15: cameras.calibration: FOLDER/lens.yaml:3: "))
        << invalid.message;
    EXPECT_EQ(refusal("source = \"synthetic:flat\"\n" + toml), Refusal{})
        << "the simulated board uses no calibration";
}

TEST_F(RigInputs, AnUnusableLevelIsReportedWithItsKey) {
    const Refusal unknown = refusal("[governor]\npin = \"foo\"\n");
    EXPECT_EQ(unknown.code, 78);
    EXPECT_TRUE(unknown.message.starts_with(
        "FOLDER/mfard.toml:2:7: governor.pin: unknown level \"foo\"; known levels: "))
        << unknown.message;
    const std::string toml = "[governor]\ndeadline_ms = 33\ntable = \"levels.toml\"\n";
    EXPECT_EQ(refusal(toml).code, 66);
    test::writeFile(folder_ / "levels.toml", "[[level]]\nname = \"a\"\nms = 1\nfoo = 2\n");
    const Refusal invalid = refusal(toml);
    EXPECT_EQ(invalid.code, 78);
    EXPECT_TRUE(invalid.message.starts_with("FOLDER/mfard.toml:3:9: governor.table: "
                                            "FOLDER/levels.toml:4:1: unknown key level[0].foo"))
        << invalid.message;
}

TEST_F(RigInputs, AnUnusableRecordingIsReportedWithItsKeyUnlessTheCommandLineNamesIt) {
    const std::filesystem::path run = folder_ / "run";
    const std::string toml = "recording = \"" + run.string() + "\"\n";
    EXPECT_EQ(refusal(toml), (Refusal{66, "FOLDER/mfard.toml:1:13: recording: FOLDER/run: there "
                                          "is no such recording"}));
    Options options;
    options.recording = folder_ / "other";
    EXPECT_EQ(refusal(toml, options), (Refusal{66, "FOLDER/other: there is no such recording"}));
    test::writeSmallRecording(run);
    std::filesystem::remove(run / "cam1/sensor.yaml");
    EXPECT_EQ(refusal(toml), Refusal{}) << "without --check-config, the lists are not checked";
    options.recording.reset();
    options.checkConfig = true;
    EXPECT_EQ(refusal(toml, options).code, 65);
}

TEST_F(RigInputs, AllFaultsAreReported) {
    const Refusal both = refusal("[cameras]\ncalibration = \"lens.yaml\"\n[governor]\npin = \"x\"\n"
                                 "[limits]\nmemory_mb = 64\n");
    EXPECT_EQ(both.code, 66);
    EXPECT_EQ(std::count(both.message.begin(), both.message.end(), '\n'), 2) << both.message;
    EXPECT_NE(both.message.find("\nFOLDER/mfard.toml:6:13: limits.memory_mb: cameras: video of"),
              both.message.npos)
        << both.message;
    EXPECT_NE(both.message.find("\nFOLDER/mfard.toml:4:7: governor.pin: "), both.message.npos)
        << both.message;
}

}  // namespace
}  // namespace mfar
