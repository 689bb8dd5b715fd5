#include "daemon/config.h"
#include "daemon/virtual_world.h"
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

TEST(VirtualConfig, EveryOptionReachesThePathTracerAndTheWarp) {
    const VirtualOptions options{VirtualRendering::PathTraced,
                                 12.5,
                                 Slicing::Spatial,
                                 16,
                                 0.5,
                                 HoleFilling::PushPull,
                                 3,
                                 false,
                                 2};
    const TracedLayerOptions out = tracedLayerOptions(options, 2);
    EXPECT_EQ(out.renderer.budgetMs, 12.5);
    EXPECT_EQ(out.renderer.slices.slicing, Slicing::Spatial);
    EXPECT_EQ(out.renderer.slices.samples, 16);
    EXPECT_EQ(out.warp.filling, HoleFilling::PushPull);
    EXPECT_EQ(out.renderer.threads, 3);
    EXPECT_FALSE(out.renderer.policy.filter);
    EXPECT_EQ(out.renderer.policy.limits.turnDegrees, 2);
    EXPECT_EQ(out.renderer.policy.shownWithin, 0) << "tiles must have the final resolution";
    EXPECT_GT(tracedLayerOptions({}, 1).renderer.policy.shownWithin, 0);
    EXPECT_EQ(out.renderer.exposure.scale, 2);
    EXPECT_EQ(out.renderer.tracer.fireflyClamp, 0.5F);
    EXPECT_EQ(layerSize(options, {200, 150}, {1000, 1000}), (Size{100, 75}));
    EXPECT_EQ(layerSize(options, {200, 150}, {60, 40}), (Size{60, 40}));
}

TEST(LightConfig, EachLightReachesTheScene) {
    const std::vector<PlacedObject> objects(1);
    const auto lightingOf = [&](LightOptions light) {
        light.environment = std::make_shared<const Environment>();
        return sceneOf(objects, light, {}).lighting;
    };
    LightOptions light;
    const Lighting studio = lightingOf(light);
    EXPECT_FALSE(studio.sun);
    light.sun = Sun{};
    light.sun->irradiance = {3, 2, 1};
    EXPECT_EQ(lightingOf(light).sun.value().irradiance, Eigen::Vector3f(3, 2, 1));
    light.source = LightSource::Sky;
    const Lighting sky = lightingOf(light);
    EXPECT_NE(sky.environment->radiance, studio.environment->radiance);
    light.sun->towards = {0, 1, 0};
    EXPECT_NE(lightingOf(light).environment->radiance, sky.environment->radiance)
        << "the sky must have its sun at the configured place";
    light.source = LightSource::File;
    EXPECT_TRUE(lightingOf(light).environment->radiance.empty())
        << "the environment must be the picture of the file";
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

TEST(LightConfig, PicturePathsAreRelativeToTheConfiguration) {
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
