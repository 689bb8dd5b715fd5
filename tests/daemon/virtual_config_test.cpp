#include "daemon/config.h"
#include "tests/daemon/config_faults.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using test::configFaults;
using testing::HasSubstr;
using testing::StartsWith;

TEST(VirtualConfig, EveryKeyIsRead) {
    const VirtualOptions options = parseConfig(R"(
[virtual]
rendering = "preview"
budget_ms = 12.5
slicing = "space"
samples = 16
resolution = 0.5
holes = "push-pull"
threads = 3
filter = false
turn_deg = 2
)",
                                               "test.toml")
                                       .virtualLayer;
    EXPECT_EQ(options, (VirtualOptions{VirtualRendering::Preview, 12.5, Slicing::Spatial, 16, 0.5,
                                       HoleFilling::PushPull, 3, false, 2}));
}

TEST(VirtualConfig, FaultsAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("[virtual]\nrendering = \"raster\"\n"),
                StartsWith("test.toml:2:13: virtual.rendering = \"raster\": must be one of "
                           "\"path-traced\", \"preview\""));
    EXPECT_THAT(configFaults("[virtual]\nbudget_ms = nan\n"),
                StartsWith("test.toml:2:13: virtual.budget_ms must be from 0.1 to 1000"));
    EXPECT_THAT(configFaults("[virtual]\nsamples = 0\n"), HasSubstr("virtual.samples must be"));
    EXPECT_THAT(configFaults("[virtual]\nholes = \"all\"\n"), HasSubstr("\"push-pull\""));
    EXPECT_THAT(configFaults("[virtual]\nresolution = 1.5\n"), HasSubstr("from 0.05 to 1"));
    EXPECT_THAT(
        configFaults("[virtual]\nbudget = 3\n"),
        HasSubstr("unknown key virtual.budget; the nearest known one is virtual.budget_ms"));
}

TEST(LightConfig, EveryKeyIsRead) {
    const LightOptions light = parseConfig(R"(
[light]
environment = "camera"
exposure = 0.5
sun = { direction = [0, 0, 2], irradiance = [3, 2, 1], radius_deg = 1 }
)",
                                           "test.toml")
                                   .light;
    EXPECT_EQ(light.source, LightSource::Camera);
    EXPECT_EQ(light.exposure, 0.5F);
    ASSERT_TRUE(light.sun);
    EXPECT_EQ(light.sun->towards, Eigen::Vector3f(0, 0, 1));
    EXPECT_EQ(light.sun->irradiance, Eigen::Vector3f(3, 2, 1));
    EXPECT_NEAR(light.sun->angularRadius, 0.01745F, 1e-4F);
}

TEST(LightConfig, MissingSunKeysHaveDefaults) {
    for (const char* keys : {"", "irradiance = [1, 1, 1]\n"}) {
        const LightOptions light =
            parseConfig(std::string("[light.sun]\n") + keys, "test.toml").light;
        ASSERT_TRUE(light.sun) << keys;
        EXPECT_NEAR(light.sun->towards.norm(), 1, 1e-6F);
        EXPECT_GT(light.sun->angularRadius, 0);
        EXPECT_GT(light.sun->irradiance.minCoeff(), 0);
    }
}

TEST(LightConfig, WithoutASunSectionThereIsNoSun) {
    EXPECT_FALSE(parseConfig("[light]\nexposure = 1.0\n", "test.toml").light.sun);
}

TEST(LightConfig, PicturePathsAreRelativeToTheFile) {
    const test::TempFolder folder;
    const std::vector<std::uint8_t> png =
        test::rgbaPng({2, 1}, {{{255, 255, 255, 255}}, {{0, 0, 0, 255}}});
    test::writeFile(folder / "room.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    const LightOptions light =
        parseConfig("[light]\nenvironment = \"room.png\"\n", (folder / "test.toml").string()).light;
    EXPECT_EQ(light.source, LightSource::File);
    EXPECT_EQ(light.file, "room.png");
    ASSERT_TRUE(light.environment);
    EXPECT_EQ(light.environment->size, (Size{2, 1}));
}

TEST(LightConfig, FaultsAreReportedWithLineAndColumn) {
    EXPECT_THAT(configFaults("[light]\nenvironment = \"dusk\"\n"),
                StartsWith("test.toml:2:15: light.environment = \"dusk\": must be \"studio\", "
                           "\"sky\", \"camera\" or a picture; dusk: is missing"));
    EXPECT_THAT(configFaults("[light]\nsun = { direction = [0, 0, 0] }\n"),
                HasSubstr("must not be zero"));
    EXPECT_THAT(configFaults("[light]\nsun = { irradiance = [-1, 0, 0] }\n"),
                HasSubstr("light.sun.irradiance must hold numbers from 0"));
    EXPECT_THAT(configFaults("[light]\nsun = \"high\"\n"),
                HasSubstr("light.sun must be a section"));
    EXPECT_THAT(configFaults("[light]\nexposure = 0\n"), HasSubstr("light.exposure must be"));
}

}  // namespace
}  // namespace mfar
