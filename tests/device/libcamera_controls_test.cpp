#include "hal/device/libcamera_controls.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

namespace controls = libcamera::controls;
using libcamera::ControlInfo;
using libcamera::ControlInfoMap;
using libcamera::ControlValue;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class LibcameraControls : public testing::Test {
protected:
    [[nodiscard]] ControlValue one(const char* name, const char* text) const {
        return parseControls(camera_, {{name, text}}).at(0).second;
    }
    void expectRefused(const char* name, const char* text) const {
        EXPECT_THAT([&] { (void)one(name, text); },
                    ThrowsMessage<std::runtime_error>(
                        AllOf(HasSubstr(name), HasSubstr("is not a valid value"))))
            << text;
    }

    ControlInfoMap camera_{
        {{&controls::AeEnable, ControlInfo(false, true)},
         {&controls::ExposureTime, ControlInfo(std::int32_t{100}, std::int32_t{66'000})},
         {&controls::AnalogueGain, ControlInfo(1.0F, 16.0F)},
         {&controls::FrameDurationLimits,
          ControlInfo(std::int64_t{8'000}, std::int64_t{1'000'000})},
         {&controls::ColourGains, ControlInfo(0.0F, 32.0F)}},
        controls::controls};
};

TEST_F(LibcameraControls, ValuesHaveTheTypeOfTheirControl) {
    EXPECT_EQ(one("ExposureTime", "8000").get<std::int32_t>(), 8000);
    EXPECT_EQ(one("AnalogueGain", "1.5").get<float>(), 1.5F);
    EXPECT_FALSE(one("AeEnable", "false").get<bool>());
    EXPECT_TRUE(one("AeEnable", "1").get<bool>());
    const ControlValues values = parseControls(camera_, {{"ExposureTime", "100"}});
    EXPECT_EQ(values.at(0).first, controls::ExposureTime.id());
}

TEST_F(LibcameraControls, ElementsOfAnArrayAreSeparatedByCommas) {
    const ControlValue limits = one("FrameDurationLimits", "33333,40000");
    ASSERT_TRUE(limits.isArray());
    const auto us = limits.get<libcamera::Span<const std::int64_t>>();
    ASSERT_EQ(us.size(), 2U);
    EXPECT_EQ(us[0], 33'333);
    EXPECT_EQ(us[1], 40'000);
    EXPECT_EQ(one("ColourGains", "1.5,2").get<libcamera::Span<const float>>()[1], 2.0F);
}

// Tests the focus, because older versions of libcamera have no separate modes of exposure and gain.
TEST_F(LibcameraControls, AFixedValueEndsItsAutomaticMode) {
    const ControlInfoMap camera({{&controls::AfMode, ControlInfo(std::int32_t{0}, std::int32_t{2})},
                                 {&controls::LensPosition, ControlInfo(0.0F, 10.0F)}},
                                controls::controls);
    const NamedValues focus{{"LensPosition", "2"}};
    EXPECT_EQ(withManualModes(camera, focus),
              (NamedValues{{"AfMode", "0"}, {"LensPosition", "2"}}));
    const NamedValues both{{"LensPosition", "2"}, {"AfMode", "1"}};
    EXPECT_EQ(withManualModes(camera, both), both);
    const NamedValues other{{"ExposureTime", "8000"}};
    EXPECT_EQ(withManualModes(camera, other), other);
    EXPECT_EQ(withManualModes(camera_, focus), focus) << "this camera has no AfMode";
}

// camera_ has the control AeEnable. In older versions of libcamera, it is the only switch for
// automatic exposure and automatic gain.
TEST_F(LibcameraControls, AFixedExposureAndGainEndTheAutomaticModeOfBoth) {
    const NamedValues both{{"ExposureTime", "8000"}, {"AnalogueGain", "2"}};
    NamedValues manual = both;
    manual.insert(manual.begin(), {"AeEnable", "false"});
    EXPECT_EQ(withManualModes(camera_, both), manual);
    NamedValues automatic = both;
    automatic.emplace_back("AeEnable", "true");
    EXPECT_EQ(withManualModes(camera_, automatic), automatic);
}

TEST_F(LibcameraControls, AnUnknownNameIsReportedWithTheExistingControls) {
    EXPECT_THAT([&] { (void)one("LensPosition", "1"); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("no control 'LensPosition'"),
                          HasSubstr("AeEnable, AnalogueGain, ColourGains, ExposureTime"))));
    EXPECT_FALSE(hasControl(camera_, "LensPosition"));
    EXPECT_TRUE(hasControl(camera_, "ExposureTime"));
}

TEST_F(LibcameraControls, ValuesOfTheWrongTypeOrOutOfRangeAreRefused) {
    for (const char* text : {"99", "66001", "", "8000.5", "8000us", "4294967396", "x"})
        expectRefused("ExposureTime", text);
    for (const char* text : {"nan", "inf", "0.5", "17", "1.0x"})
        expectRefused("AnalogueGain", text);
    for (const char* text : {"yes", "2"})
        expectRefused("AeEnable", text);
    for (const char* text : {"33333,", ",33333", "1,x"})
        expectRefused("FrameDurationLimits", text);
    EXPECT_THAT([&] { (void)one("ExposureTime", "0"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("[100..66000]")));
}

}  // namespace
}  // namespace mfar
