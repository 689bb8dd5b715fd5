#include "daemon/config.h"
#include "daemon/limits_config.h"
#include "daemon/rig.h"
#include "tests/daemon/config_faults.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/small_recording.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace mfar {
namespace {

using test::configFaults;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Returns the beginning and the end of a PNG file of this size, without pixels. These bytes are
/// checked before the file is decoded.
std::string pngThatClaims(std::uint16_t width, std::uint16_t height) {
    std::string out("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0..\0\0..", 24);
    out[18] = static_cast<char>(width >> 8U);
    out[19] = static_cast<char>(width);
    out[22] = static_cast<char>(height >> 8U);
    out[23] = static_cast<char>(height);
    return out + std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12);
}

std::string refusalOf(const Config& config) {
    Heartbeats hearts;
    try {
        const Rig rig(config, hearts);
        return "none";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code, ExitCode::BadData);
        return failure.what();
    }
}

TEST(Limits, TheMemoryLimitComesFromTheMachineOrTheConfiguration) {
    EXPECT_GT(machineMemory(), 100U << 20U);
    EXPECT_LT(LimitsConfig{}.memoryBytes(), machineMemory());
    EXPECT_EQ(LimitsConfig{100}.memoryBytes(), 100U << 20U);
    EXPECT_EQ(parseConfig("[limits]\nmemory_mb = 512\n", "a").limits.memoryMb, 512);
    EXPECT_THAT(configFaults("[limits]\nmemory_mb = 3\n"),
                StartsWith("test.toml:2:13: limits.memory_mb = 3: must be 0 or at least 64"));
}

TEST(Limits, TheDefaultIsThreeQuartersOfTheMemoryButAtMostFourGigabytes) {
    constexpr std::uint64_t kGigabyte = 1U << 30U;
    EXPECT_EQ(defaultMemory(kGigabyte), kGigabyte / 4 * 3);
    EXPECT_EQ(defaultMemory(16 * kGigabyte), 4 * kGigabyte);
}

TEST(Limits, TheSmallestLimitOfTheControlGroupsCounts) {
    const test::TempFolder folder;
    std::filesystem::create_directories(folder / "system.slice/mfard.service");
    const auto write = [&](const char* file, const char* text) {
        std::ofstream(folder / file) << text;
    };
    const auto memory = [&] { return controlGroupMemory(folder / "list", folder.path()); };
    EXPECT_EQ(memory(), 0U);
    write("list", "1:name=old:/\n0::/system.slice/mfard.service\n");
    EXPECT_EQ(memory(), 0U);
    write("system.slice/mfard.service/memory.max", "max\n");
    EXPECT_EQ(memory(), 0U);
    write("memory.max", "8000000\n");
    EXPECT_EQ(memory(), 8000000U);
    write("system.slice/memory.max", "5000000\n");
    write("system.slice/mfard.service/memory.max", "6000000\n");
    EXPECT_EQ(memory(), 5000000U);
}

TEST(Limits, ARecordingOfLargePicturesIsRefusedBeforeMemoryIsAllocated) {
    const test::TempFolder folder;
    test::writeSmallRecording(folder.path());
    Config config;
    config.recording = folder.path();
    config.limits.memoryMb = 64;
    EXPECT_EQ(refusalOf(config), "none");
    test::replaceInFile(folder / "cam1/sensor.yaml", "[32, 24]", "[16384, 16384]");
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cam1/data"))
        test::writeFile(entry.path(), pngThatClaims(16384, 16384));
    test::replaceInFile(folder / "cam1/sensor.yaml", "20.5, 21.5, 7.5, 5.5",
                        "16384, 16384, 8000, 8000");
    config.limits.memoryMb = 4096;
    EXPECT_THAT(refusalOf(config),
                AllOf(StartsWith(folder.path().string() + ": video of 16x12 and stills of "
                                                          "16384x16384 need about 9"),
                      HasSubstr("4096 MB of [limits] memory_mb")));
}

TEST(Limits, ARecordingWithLongListsIsRefusedBeforeMemoryIsAllocated) {
    const test::TempFolder folder;
    test::writeSmallRecording(folder.path());
    std::string poses;
    for (int i = 0; i < 100'000; ++i)
        poses += fmt::format("{},0,0,0,1,0,0,0\n", 1'000'000'000 + i);
    const std::filesystem::path list = folder / "state_groundtruth_estimate0/data.csv";
    test::writeFile(list, poses);
    Config config;
    config.recording = folder.path();
    config.limits.memoryMb = 512;
    EXPECT_EQ(refusalOf(config), "none");
    config.limits.memoryMb = 64;
    EXPECT_THAT(refusalOf(config),
                AllOf(StartsWith(list.string() + ":5"),
                      HasSubstr("the lists of this recording take more than 42 MB")));
}

TEST(Limits, CamerasWithLargePicturesAreRefused) {
    Config config;
    config.cameras.still.size = {8192, 8192};
    config.limits.memoryMb = 1024;
    EXPECT_THAT(refusalOf(config), StartsWith("cameras: video of 640x480 and stills of 8192x8192"));
}

TEST(Limits, ASimulatedBoardWithLargePicturesIsRefused) {
    Config config;
    config.source = "synthetic:flat";
    config.limits.memoryMb = 64;
    EXPECT_THAT(refusalOf(config),
                StartsWith("synthetic:flat: video of 640x480 and stills of 2304x1728 need about"));
}

TEST(Limits, AModelThatNeedsTooMuchMemoryIsReportedWithLineAndColumn) {
    const test::TempFolder folder;
    test::GltfMaker textured = test::richModel();
    textured.texture(test::rgbaPng({1024, 1024}, std::vector<std::array<std::uint8_t, 4>>(1 << 20)),
                     "image/png");
    textured.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
        textured.root["textures"].size() - 1;
    const std::vector<std::uint8_t> glb = textured.glb();
    test::writeFile(folder / "large.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
    const std::string object = "[[objects]]\nmodel = \"" + (folder / "large.glb").string() + "\"\n";
    EXPECT_EQ(configFaults("[limits]\nmemory_mb = 512\n" + object), "");
    EXPECT_THAT(configFaults("[limits]\nmemory_mb = 64\n" + object),
                AllOf(StartsWith("test.toml:4:9: objects[0].model"),
                      HasSubstr("large.glb: images["),
                      HasSubstr("the textures of the model have more than")));
}

TEST(Limits, AModelFileNamedByDifferentPathsIsReadOnce) {
    const test::TempFolder folder;
    const std::vector<std::uint8_t> glb = test::oneTriangle().glb();
    test::writeFile(folder / "a/thing.glb",
                    {reinterpret_cast<const char*>(glb.data()), glb.size()});
    const Config config = parseConfig("[[objects]]\nmodel = \"a/thing.glb\"\n"
                                      "[[objects]]\nmodel = \"a/../a/./thing.glb\"\n",
                                      (folder / "test.toml").string());
    ASSERT_EQ(config.objects.size(), 2U);
    EXPECT_EQ(config.objects[0].model, config.objects[1].model);
}

TEST(Limits, AnEnvironmentPictureThatNeedsTooMuchMemoryIsReportedWithLineAndColumn) {
    const test::TempFolder folder;
    test::writeFile(folder / "sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4096 +X 8192\n");
    EXPECT_THAT(configFaults("[limits]\nmemory_mb = 64\n[light]\nenvironment = \"" +
                             (folder / "sky.hdr").string() + "\"\n"),
                AllOf(StartsWith("test.toml:4:15: light.environment"),
                      HasSubstr("sky.hdr: the picture of 2048x1024 pixels needs 32 MB")));
}

}  // namespace
}  // namespace mfar
