#include "hal/device/camera_selection.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<ListedCamera> kBoard{{"/base/i2c@1/imx296@1a", "imx296", "back"},
                                       {"/base/i2c@0/imx477@1a", "imx477", "front"},
                                       {"usb-1.2-046d:0825", "Webcam C270", "external"},
                                       {"usb-1.3-046d:0825", "Webcam C270", "external"}};

TEST(CameraSelection, CamerasAreFoundByIdLocationOrModel) {
    EXPECT_EQ(chooseCamera(kBoard, {"usb-1.3-046d:0825"}), 3U);
    EXPECT_EQ(chooseCamera(kBoard, {"front"}), 1U);
    EXPECT_EQ(chooseCamera(kBoard, {"imx296"}), 0U);
}

TEST(CameraSelection, IdsTakePrecedenceOverModels) {
    EXPECT_EQ(chooseCamera({{"a", "b", ""}, {"b", "c", ""}}, {"b"}), 1U);
}

TEST(CameraSelection, WithoutANameTheCameraWithTheSmallestOrLargestPicturesIsChosen) {
    std::vector<ListedCamera> board = kBoard;
    for (ListedCamera& camera : board)
        camera.pixels = 1000;
    board[3].pixels = 4000;
    board[1].pixels = 4000;
    EXPECT_EQ(chooseCamera(board, {}), 0U);
    EXPECT_EQ(chooseCamera(board, {.largest = true}), 3U);
    EXPECT_EQ(chooseCamera(board, {.except = "imx296"}), 2U);
    EXPECT_EQ(chooseCamera(board, {.except = board[3].id, .largest = true}), 1U);
    EXPECT_EQ(chooseCamera(board, {.except = "external", .largest = true}), 1U);
}

TEST(CameraSelection, WithOnlyOneCameraNoSecondOneIsFound) {
    const std::vector<ListedCamera> one{{"a", "b", ""}};
    EXPECT_EQ(chooseCamera(one, {}), 0U);
    EXPECT_THAT(
        [&] { (void)chooseCamera(one, {.largest = true}); },
        ThrowsMessage<std::runtime_error>(HasSubstr("no second camera was found; available: 'a'")));
    EXPECT_THAT([&] { (void)chooseCamera(one, {.except = "a"}); },
                ThrowsMessage<std::runtime_error>(HasSubstr("no second camera was found")));
    EXPECT_EQ(chooseCamera(one, {.except = "not there", .largest = true}), 0U);
}

TEST(CameraSelection, AmbiguousAndUnknownNamesAreReportedWithTheCameras) {
    for (const char* wanted : {"external", "Webcam C270", "imx219", "usb-1.2"})
        EXPECT_THAT([&] { (void)chooseCamera(kBoard, {wanted}); },
                    ThrowsMessage<std::runtime_error>(AllOf(
                        HasSubstr(wanted),
                        HasSubstr("'/base/i2c@1/imx296@1a' (model imx296, location back)"),
                        HasSubstr("'usb-1.3-046d:0825' (model Webcam C270, location external)"))));
}

TEST(CameraSelection, WithoutCamerasTheMessageNamesTheOtherDriver) {
    EXPECT_THAT(
        [] { (void)chooseCamera({}, {"imx296"}); },
        ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("finds no camera"), HasSubstr("v4l2"))));
}

}  // namespace
}  // namespace mfar
