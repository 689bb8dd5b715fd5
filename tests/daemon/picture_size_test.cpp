#include "daemon/picture_size.h"
#include "tests/daemon/config_faults.h"

#include <gmock/gmock.h>

namespace mfar {
namespace {

using Fits = PictureSize::Fits;
using test::configFaults;
using testing::HasSubstr;

StereoRig product() {
    StereoRig rig;
    rig.video = {{640, 480}, 600, 600, 319.5, 239.5, {}};
    rig.still = {{2304, 1728}, 2160, 2160, 1151.5, 863.5, {}};
    return rig;
}

TEST(PictureSize, ValidSizesAreParsedAndOthersRefused) {
    EXPECT_EQ(pictureSize("screen"), PictureSize{});
    EXPECT_EQ(pictureSize("still"), (PictureSize{Fits::Still, {}}));
    EXPECT_EQ(pictureSize("1280x720"), (PictureSize{Fits::Given, {1280, 720}}));
    for (const char* wrong : {"", "Screen", "1280", "x", "0x5", "5x0", "-1x5", "1280x", "x720",
                              "1280x720 ", "1280 x 720", "99999x5", "1e3x5", "1280x720x3"}) {
        EXPECT_FALSE(pictureSize(wrong)) << wrong;
        EXPECT_THAT(pictureSizeFault(wrong).value_or(""), HasSubstr("1280x720")) << wrong;
    }
}

TEST(PictureSize, OutputFillsTheScreen) {
    const StereoRig rig = product();
    EXPECT_EQ(outputSizeFor({}, rig, Size{1920, 1080}), (Size{1440, 1080}));
    EXPECT_EQ(outputSizeFor({}, rig, Size{1280, 800}), (Size{1067, 800}));
    EXPECT_EQ(outputSizeFor({}, rig, Size{1080, 1920}), (Size{1080, 810}));
    EXPECT_EQ(outputSizeFor({}, rig, Size{3840, 2160}), (Size{2304, 1728}));
    EXPECT_EQ(outputSizeFor({}, rig, Size{320, 240}), (Size{640, 480}));
    EXPECT_EQ(outputSizeFor({}, rig, std::nullopt), (Size{2304, 1728}));
    EXPECT_EQ(outputSizeFor({}, rig, Size{0, 0}), (Size{2304, 1728}));
}

TEST(PictureSize, OutputHasTheRequestedSize) {
    const StereoRig rig = product();
    EXPECT_EQ(outputSizeFor({Fits::Still, {}}, rig, Size{640, 480}), (Size{2304, 1728}));
    EXPECT_EQ(outputSizeFor({Fits::Given, {1024, 9999}}, rig, Size{640, 480}), (Size{1024, 768}));
    EXPECT_EQ(outputSizeFor({Fits::Given, {9999, 9999}}, rig, {}), (Size{2304, 1728}));
}

TEST(PictureSize, ConfiguredSizeIsRead) {
    EXPECT_EQ(parseConfig("size = \"800x600\"", "f").size, (PictureSize{Fits::Given, {800, 600}}));
    EXPECT_EQ(parseConfig("", "f").size, PictureSize{});
    EXPECT_THAT(configFaults("size = \"large\"\n"), HasSubstr("test.toml:1:"));
}

}  // namespace
}  // namespace mfar
