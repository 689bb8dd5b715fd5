#include "hal/device/trigger_gpiod.h"
#include "hal/device/trigger_safe_level.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// This test passes on every machine, with or without GPIO chips.
TEST(GpioTrigger, AnUnknownChipIsRefusedAndNamed) {
    TriggerOptions options;
    options.chip = "no-such-chip";
    options.line = "2";
    EXPECT_THAT([&] { (void)openGpioTrigger(options); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'no-such-chip'")));
    EXPECT_THAT([&] { driveSafe(options); },
                ThrowsMessage<std::runtime_error>(HasSubstr("'no-such-chip'")));
}

TEST(GpioTrigger, EveryListedChipHasAPathAndLinesOrAnError) {
    const std::vector<GpioChip> chips = listGpioChips();
    if (chips.empty()) GTEST_SKIP() << "no GPIO chip";
    for (const GpioChip& chip : chips) {
        EXPECT_EQ(chip.path, "/dev/" + chip.name);
        EXPECT_TRUE(!chip.lines.empty() || chip.error != 0) << chip.path;
    }
}

}  // namespace
}  // namespace mfar
