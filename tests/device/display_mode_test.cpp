#include "hal/device/display_drm.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mfar {
namespace {

constexpr std::uint32_t kPreferred = DRM_MODE_TYPE_PREFERRED;

// A mode with 10 % blanking in each direction. Its pixel clock is rounded to kHz.
drmModeModeInfo mode(int width, int height, double hz, std::uint32_t type = 0,
                     std::uint32_t flags = 0) {
    drmModeModeInfo m{};
    m.hdisplay = static_cast<std::uint16_t>(width);
    m.vdisplay = static_cast<std::uint16_t>(height);
    m.htotal = static_cast<std::uint16_t>(width + width / 10);
    m.vtotal = static_cast<std::uint16_t>(height + height / 10);
    m.vrefresh = static_cast<std::uint32_t>(std::lround(hz));
    const double frames = (flags & DRM_MODE_FLAG_INTERLACE) != 0 ? hz / 2 : hz;
    m.clock = static_cast<std::uint32_t>(std::lround(frames * m.htotal * m.vtotal / 1000));
    m.type = type;
    m.flags = flags;
    return m;
}

const std::vector<drmModeModeInfo> kMonitor{
    mode(3840, 2160, 30),    mode(1920, 1080, 60, 0, DRM_MODE_FLAG_INTERLACE),
    mode(1920, 1080, 59.94), mode(1920, 1080, 60, kPreferred),
    mode(1920, 1080, 50),    mode(1280, 720, 50),
    mode(1280, 720, 60),
};

std::string chosen(const std::vector<drmModeModeInfo>& modes, std::optional<ModeWish> wish) {
    const auto m = chooseMode(modes, wish);
    if (!m) return "none";
    const bool interlaced = (m->flags & DRM_MODE_FLAG_INTERLACE) != 0;
    return std::to_string(m->hdisplay) + "x" + std::to_string(m->vdisplay) + "@" +
           std::to_string(std::lround(refreshHz(*m) * 100)) + (interlaced ? "i" : "");
}

TEST(ChooseMode, ChoosesTheModeThatTheMonitorPrefersUnlessAnotherIsConfigured) {
    EXPECT_EQ(chosen(kMonitor, {}), "1920x1080@6000");
    EXPECT_EQ(chosen(kMonitor, ModeWish{{1280, 720}, 50.0}), "1280x720@5000");
    EXPECT_EQ(chosen(kMonitor, ModeWish{{1280, 720}, {}}), "1280x720@6000");
    EXPECT_EQ(chosen(kMonitor, ModeWish{{3840, 2160}, 30.0}), "3840x2160@3000");
}

TEST(ChooseMode, ChoosesTheModeOfTheNearestRateAndPrefersProgressiveModes) {
    EXPECT_EQ(chosen(kMonitor, ModeWish{{1920, 1080}, 60.0}), "1920x1080@6000");
    EXPECT_EQ(chosen(kMonitor, ModeWish{{1920, 1080}, 59.94}), "1920x1080@5994");
    const std::vector interlacedOnly{mode(1280, 720, 60, kPreferred),
                                     mode(1920, 1080, 50, 0, DRM_MODE_FLAG_INTERLACE)};
    EXPECT_EQ(chosen(interlacedOnly, ModeWish{{1920, 1080}, 50.0}), "1920x1080@5000i");
}

TEST(ChooseMode, AnUnavailableModeFallsBackToThePreferredOne) {
    const ModeWish tooFast{{1280, 720}, 75.0};
    EXPECT_EQ(chosen(kMonitor, tooFast), "1920x1080@6000");
    EXPECT_EQ(chosen(kMonitor, ModeWish{{800, 600}, {}}), "1920x1080@6000");
    EXPECT_FALSE(fulfils(*chooseMode(kMonitor, tooFast), tooFast));
    const std::vector nothingPreferred{mode(1024, 768, 60), mode(800, 600, 60)};
    EXPECT_EQ(chosen(nothingPreferred, {}), "1024x768@6000");
}

TEST(ChooseMode, ImpossibleModesAreIgnored) {
    const std::vector impossible{mode(0, 720, 60, kPreferred), mode(1280, 0, 60),
                                 mode(20000, 100, 60), drmModeModeInfo{}};
    EXPECT_EQ(chosen(impossible, {}), "none");
    EXPECT_EQ(chosen({}, {}), "none");
    drmModeModeInfo stopped = mode(1280, 720, 60);
    stopped.clock = 0;
    EXPECT_DOUBLE_EQ(refreshHz(stopped), 60);
    stopped.vrefresh = 0;
    EXPECT_EQ(chosen({stopped}, {}), "none");
}

struct TalkingCard {
    TalkingCard() {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) throw std::runtime_error("pipe() failed");
        told = OwnedFd(ends[0]);
        tells = OwnedFd(ends[1]);
    }
    void tell(std::uint32_t type, bool& pending) const {
        drm_event_vblank event{};
        event.base = {type, sizeof event};
        event.user_data = reinterpret_cast<std::uintptr_t>(&pending);
        ASSERT_EQ(write(tells.get(), &event, sizeof event), ssize_t{sizeof event});
    }

    OwnedFd told, tells;
};

TEST(WaitForFlip, EndsWithTheEventOfTheFlip) {
    const TalkingCard card;
    bool pending = true;
    card.tell(DRM_EVENT_VBLANK, pending);
    card.tell(DRM_EVENT_FLIP_COMPLETE, pending);
    EXPECT_TRUE(waitForFlip(card.told.get(), pending, std::chrono::seconds(60)));
    EXPECT_FALSE(pending);
    EXPECT_TRUE(waitForFlip(card.told.get(), pending, std::chrono::seconds(60)))
        << "without a pending flip there is nothing to wait for";
}

TEST(WaitForFlip, WithoutAFlipTheWaitEndsAtTheLimitDespiteOtherEvents) {
    const TalkingCard card;
    bool pending = true;
    const std::jthread other([&](const std::stop_token& stop) {
        bool nobody = true;
        while (!stop.stop_requested()) {
            card.tell(DRM_EVENT_VBLANK, nobody);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });
    EXPECT_FALSE(waitForFlip(card.told.get(), pending, std::chrono::milliseconds(20)));
    EXPECT_TRUE(pending);
}

TEST(WaitForFlip, EndsWhenTheCardIsGone) {
    TalkingCard card;
    card.tells = OwnedFd();
    bool pending = true;
    EXPECT_FALSE(waitForFlip(card.told.get(), pending, std::chrono::seconds(60)));
}

}  // namespace
}  // namespace mfar
