#include "hal/device/gpio_selection.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<GpioChip> board() {
    GpioChip main{"/dev/gpiochip0", "gpiochip0", "pinctrl-bcm2711", {}};
    main.lines = {{0, "ID_SDA", "", false},
                  {1, "", "", false},
                  {2, "TRIGGER", "", false},
                  {3, "RESET", "reset-gpios", true},
                  {4, "", "", true}};
    GpioChip expander{"/dev/gpiochip1", "gpiochip1", "raspberrypi-exp-gpio", {}};
    expander.lines = {{0, "BT_ON", "", false}, {1, "RESET", "", false}};
    return {main, expander};
}

std::string faultOf(const std::vector<GpioChip>& chips, std::string_view chip,
                    std::string_view line) {
    try {
        (void)findGpioLine(chips, chip, line);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(GpioSelection, FindsTheChipByPathNameAndLabel) {
    for (const char* chip : {"/dev/gpiochip1", "gpiochip1", "raspberrypi-exp-gpio"}) {
        const GpioAddress line = findGpioLine(board(), chip, "1");
        EXPECT_EQ(line.path, "/dev/gpiochip1") << chip;
        EXPECT_EQ(line.offset, 1U) << chip;
        EXPECT_EQ(line.text, "line 1 'RESET' of gpiochip1 (raspberrypi-exp-gpio)");
    }
}

TEST(GpioSelection, FindsTheLineByNameWithAndWithoutItsChip) {
    EXPECT_EQ(findGpioLine(board(), "", "TRIGGER").offset, 2U);
    EXPECT_EQ(findGpioLine(board(), "pinctrl-bcm2711", "TRIGGER").offset, 2U);
    EXPECT_EQ(findGpioLine(board(), "gpiochip0", "RESET").offset, 3U);
}

TEST(GpioSelection, AnUnknownChipIsReportedWithTheExistingChips) {
    EXPECT_THAT(faultOf(board(), "pinctrl-rp1", "2"),
                AllOf(HasSubstr("'pinctrl-rp1'"), HasSubstr("gpiochip0 (pinctrl-bcm2711, 5 lines)"),
                      HasSubstr("gpiochip1 (raspberrypi-exp-gpio, 2 lines)")));
}

TEST(GpioSelection, AnUnknownLineIsReportedWithTheNamedLinesOfThePossibleChips) {
    EXPECT_THAT(faultOf(board(), "", "TRIGER"),
                AllOf(HasSubstr("'TRIGER'"), HasSubstr("gpiochip0: ID_SDA, TRIGGER, RESET"),
                      HasSubstr("gpiochip1: BT_ON, RESET")));
    EXPECT_THAT(faultOf(board(), "gpiochip1", "TRIGGER"),
                AllOf(HasSubstr("BT_ON"), Not(HasSubstr("ID_SDA"))));
    EXPECT_THAT(faultOf(board(), "gpiochip0", "5"), HasSubstr("no line 5"));
}

TEST(GpioSelection, AmbiguousNamesAreRefused) {
    EXPECT_THAT(faultOf(board(), "", "RESET"),
                AllOf(HasSubstr("more than one"), HasSubstr("line 3 'RESET' of gpiochip0"),
                      HasSubstr("line 1 'RESET' of gpiochip1")));
    EXPECT_THAT(faultOf(board(), "", "2"), HasSubstr("`chip` must be set"));
    std::vector<GpioChip> twins = board();
    twins[1].label = twins[0].label;
    EXPECT_THAT(faultOf(twins, "pinctrl-bcm2711", "1"), HasSubstr("2 GPIO chips have the label"));
    EXPECT_EQ(findGpioLine(twins, "pinctrl-bcm2711", "BT_ON").path, "/dev/gpiochip1");
    EXPECT_THAT(faultOf(board(), "gpiochip0", ""), HasSubstr("no GPIO line is given"));
}

TEST(GpioSelection, ALineNumberMustConsistOfDigits) {
    for (const char* line : {"-1", "2x", " 2", "+2", "4294967296", "0x2"})
        EXPECT_THAT(faultOf(board(), "gpiochip0", line), HasSubstr("no GPIO line is named"))
            << line;
}

TEST(GpioSelection, ADeniedPermissionIsReportedWithTheGroupThatHasIt) {
    std::vector<GpioChip> chips = board();
    chips[0] = {"/dev/gpiochip0", "gpiochip0", "", {}, EACCES};
    for (const auto& [chip, line] : {std::pair{"gpiochip0", "2"}, std::pair{"", "TRIGGER"},
                                     std::pair{"pinctrl-bcm2711", "TRIGGER"}})
        EXPECT_THAT(faultOf(chips, chip, line),
                    AllOf(HasSubstr("permission denied"), HasSubstr("group gpio")))
            << chip << " " << line;
    EXPECT_THAT(gpioRequestFault(findGpioLine(board(), "", "TRIGGER"), EPERM),
                HasSubstr("group gpio"));
}

TEST(GpioSelection, ABusyLineIsReportedWithTheProgramThatUsesIt) {
    EXPECT_THAT(gpioRequestFault(findGpioLine(board(), "gpiochip0", "RESET"), EBUSY),
                HasSubstr("in use by 'reset-gpios'"));
    EXPECT_THAT(gpioRequestFault(findGpioLine(board(), "gpiochip0", "4"), EBUSY),
                HasSubstr("in use by the kernel"));
    EXPECT_THAT(gpioRequestFault(findGpioLine(board(), "gpiochip0", "1"), EBUSY),
                HasSubstr("in use by another program"));
}

TEST(GpioSelection, MissingChipsAreReported) {
    EXPECT_THAT(faultOf({}, "gpiochip0", "2"), HasSubstr("no GPIO chip that programs can use"));
    EXPECT_EQ(faultOf({}, "", "TRIGGER"), "no GPIO line is named 'TRIGGER'; this machine has no "
                                          "GPIO chip that programs can use");
    EXPECT_THAT(faultOf({}, "", "2"), HasSubstr("`chip` must be set"));
}

TEST(GpioSelection, AChipIsFoundThroughALink) {
    const test::TempFolder folder;
    std::vector<GpioChip> chips = board();
    chips[1].path = folder.path() / "gpiochip1";
    std::ofstream(folder.path() / "gpiochip1") << ' ';
    std::filesystem::create_symlink("gpiochip1", folder.path() / "expander");
    EXPECT_EQ(findGpioLine(chips, (folder.path() / "expander").string(), "BT_ON").path,
              chips[1].path);
}

TEST(GpioSelection, ChipsComeInTheOrderOfTheirNumbers) {
    const test::TempFolder folder;
    for (const char* name : {"gpiochip10", "gpiochip2", "gpiochip0", "gpiochipX", "gpio", "null"})
        std::ofstream(folder.path() / name) << ' ';
    // Raspberry Pi OS creates such a link. The chip must not be found twice.
    std::filesystem::create_symlink("gpiochip0", folder.path() / "gpiochip4");
    const std::string root = folder.path();
    EXPECT_THAT(gpioChipPaths(root),
                ElementsAre(root + "/gpiochip0", root + "/gpiochip2", root + "/gpiochip10"));
    EXPECT_THAT(gpioChipPaths(root + "/none"), IsEmpty());
}

}  // namespace
}  // namespace mfar
