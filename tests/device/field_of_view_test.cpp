#include "hal/device/field_of_view.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

TEST(FieldOfView, UncroppedModesShowTheWholeFieldOfView) {
    EXPECT_TRUE(showsWholeField({4056, 3040}, {4056, 3040}, {640, 480}));
    EXPECT_TRUE(showsWholeField({4032, 3024}, {4056, 3040}, {640, 480}))
        << "cropping for alignment must not count";
}

TEST(FieldOfView, CroppingToTheAspectRatioOfTheOutputIsAllowed) {
    EXPECT_TRUE(showsWholeField({1440, 1080}, {1920, 1080}, {640, 480}));
    EXPECT_TRUE(showsWholeField({4056, 2282}, {4056, 3040}, {1920, 1080}));
}

TEST(FieldOfView, CroppedModesAreDetected) {
    // An imx477 at 1332x990 uses only the central 2664x1980 pixels, not its whole field.
    EXPECT_FALSE(showsWholeField({2664, 1980}, {4056, 3040}, {640, 480}));
    EXPECT_FALSE(showsWholeField({1280, 720}, {1920, 1080}, {640, 480}));
    EXPECT_FALSE(showsWholeField({1440, 900}, {1920, 1080}, {640, 480}));
    EXPECT_FALSE(showsWholeField({1200, 1080}, {1920, 1080}, {640, 480}));
}

TEST(FieldOfView, EmptySizesNeverShowTheWholeFieldOfView) {
    EXPECT_FALSE(showsWholeField({0, 0}, {4056, 3040}, {640, 480}));
    EXPECT_FALSE(showsWholeField({4056, 3040}, {0, 3040}, {640, 480}));
    EXPECT_FALSE(showsWholeField({4056, 3040}, {4056, 3040}, {640, -1}));
}

}  // namespace
}  // namespace mfar
