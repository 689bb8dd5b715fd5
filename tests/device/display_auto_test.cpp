#include "hal/device/display_auto.h"
#include "hal/device/display_spec.h"
#include "tests/engine/gl_test.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

using Presence = Screen::Presence;
using testing::HasSubstr;

struct Device {
    Presence presence = Presence::Absent;
    bool refuses = false;
    int refusesAfter = 1000000;  // number of pictures after which show() throws
    int shown = 0, looks = 0, thoroughLooks = 0, released = 0;
    bool held = false;
    Size size{640, 400};
};

class FakeScreen final : public Screen {
public:
    FakeScreen(std::string name, Device& device) : name_(std::move(name)), device_(device) {}

    Presence look(bool thorough) override {
        ++device_.looks;
        device_.thoroughLooks += thorough ? 1 : 0;
        device_.held = device_.presence != Presence::Absent;
        return device_.presence;
    }
    [[nodiscard]] Size size() const override { return device_.size; }
    void show(const Picture&) override {
        if (device_.refuses || device_.shown >= device_.refusesAfter ||
            device_.presence != Presence::Ready)
            throw std::runtime_error(name_ + " is broken");
        ++device_.shown;
    }
    void releaseGl() override { ++device_.released; }
    void close() override { device_.held = false; }
    [[nodiscard]] std::string status() const override {
        return name_ + (device_.held ? " held" : " missing");
    }
    [[nodiscard]] std::optional<ScreenPicture> lastShown() const override {
        return ScreenPicture{{1, 1}, PixelFormat::Rgba8, {1, 2, 3, 4}};
    }

private:
    std::string name_;
    Device& device_;
};

class AutoDisplay : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        std::vector<std::unique_ptr<Screen>> screens;
        screens.push_back(std::make_unique<FakeScreen>("kms", kms_));
        screens.push_back(std::make_unique<FakeScreen>("fbdev", fbdev_));
        display_ = std::make_unique<ScreenDisplay>(
            nullptr, std::move(screens), [this] { return now_; },
            [this] { return std::exchange(changed_, false); });
    }
    // Shows pictures at 20 Hz for the time `duration`. Returns the number of pictures that the two
    // screens showed.
    int run(std::chrono::milliseconds duration) {
        const int before = kms_.shown + fbdev_.shown;
        for (const Timestamp end = now_ + duration; now_ < end;
             now_ = now_ + std::chrono::milliseconds(50))
            display_->show({}, now_);
        return kms_.shown + fbdev_.shown - before;
    }

    Device kms_, fbdev_;
    Timestamp now_ = Timestamp::fromSeconds(100);
    bool changed_ = false;
    std::unique_ptr<ScreenDisplay> display_;
};

constexpr std::chrono::milliseconds kSecond{1000};

TEST_F(AutoDisplay, RunsWithoutAScreenAndReportsIt) {
    EXPECT_EQ(run(kSecond * 2), 0);
    EXPECT_THAT(display_->name(), HasSubstr("no screen yet"));
    EXPECT_THAT(display_->name(), HasSubstr("kms missing; fbdev missing"));
    EXPECT_EQ(display_->fault(), display_->name());
    EXPECT_FALSE(display_->lastShown());
    EXPECT_LE(kms_.looks, 5);  // the display looks for a missing screen twice a second
    EXPECT_NO_THROW(display_->finish());
}

TEST_F(AutoDisplay, HasTheSizeOfTheConnectedScreen) {
    EXPECT_FALSE(display_->screenSize());
    fbdev_.presence = Presence::Ready;
    changed_ = true;
    EXPECT_EQ(display_->screenSize(), (Size{640, 400}));
    kms_.presence = Presence::Ready;
    kms_.size = {1280, 720};
    changed_ = true;
    EXPECT_EQ(display_->screenSize(), (Size{1280, 720}));
    run(kSecond);
    EXPECT_EQ(kms_.shown, 20);
    kms_.presence = fbdev_.presence = Presence::Absent;
    changed_ = true;
    EXPECT_FALSE(display_->screenSize());
}

TEST_F(AutoDisplay, ShowsWithinASecondAfterADeviceAppears) {
    run(kSecond * 2);
    fbdev_.presence = Presence::Ready;
    EXPECT_GE(run(kSecond), 10);
    EXPECT_EQ(display_->name(), "fbdev held (kms missing)");
    EXPECT_EQ(display_->fault(), std::nullopt);
    EXPECT_TRUE(display_->lastShown());
}

TEST_F(AutoDisplay, AScreenIsUsedAtOnceAfterAKernelEvent) {
    run(std::chrono::milliseconds(600));
    kms_.presence = Presence::Ready;
    changed_ = true;
    EXPECT_EQ(run(std::chrono::milliseconds(100)), 2);
}

TEST_F(AutoDisplay, PrefersTheFirstDeviceAndReleasesTheSecond) {
    fbdev_.presence = Presence::Ready;
    run(kSecond);
    kms_.presence = Presence::Ready;
    changed_ = true;
    run(kSecond);
    EXPECT_EQ(display_->name(), "kms held");
    EXPECT_FALSE(fbdev_.held);
}

TEST_F(AutoDisplay, OpensNoOtherDeviceWhileAScreenShowsPictures) {
    kms_.presence = Presence::Ready;
    run(kSecond);
    const int looks = fbdev_.looks;
    EXPECT_EQ(run(kSecond * 15), 300);
    EXPECT_EQ(fbdev_.looks, looks);
    EXPECT_EQ(kms_.thoroughLooks, 1);
}

TEST_F(AutoDisplay, ChecksAPreferredDeviceEveryFiveSecondsWithoutAnEvent) {
    fbdev_.presence = Presence::Ready;
    run(kSecond);
    const int looks = kms_.looks;
    EXPECT_EQ(run(kSecond * 15), 300);
    EXPECT_NEAR(kms_.looks - looks, 3, 1);
    kms_.presence = Presence::Ready;
    EXPECT_GE(run(kSecond * 6), 110);
    EXPECT_EQ(display_->name(), "kms held");
    EXPECT_FALSE(fbdev_.held);
}

TEST_F(AutoDisplay, WaitsForTheMonitorOfAnOpenDevice) {
    kms_.presence = Presence::Waiting;
    fbdev_.presence = Presence::Ready;
    EXPECT_EQ(run(kSecond), 0);
    EXPECT_FALSE(fbdev_.held);
    kms_.presence = Presence::Ready;
    EXPECT_GE(run(kSecond), 10);
    EXPECT_EQ(fbdev_.shown, 0);
}

TEST_F(AutoDisplay, ReturnsToAScreenThatWasLostForAMoment) {
    kms_.presence = fbdev_.presence = Presence::Ready;
    run(kSecond);
    kms_.refuses = true;
    EXPECT_EQ(run(std::chrono::milliseconds(100)), 0);
    EXPECT_FALSE(kms_.held);
    EXPECT_THAT(display_->name(), HasSubstr("no screen yet (kms is broken"));
    kms_.refuses = false;
    EXPECT_GE(run(kSecond), 10);
    EXPECT_EQ(display_->name(), "kms held");
    EXPECT_EQ(fbdev_.shown, 0);
    kms_.presence = fbdev_.presence = Presence::Absent;
    changed_ = true;
    run(kSecond);
    EXPECT_EQ(display_->name(), "no screen yet (kms missing; fbdev missing)");
}

// Each time that it is opened, this screen shows two pictures and fails at the third, like a screen
// whose flips do not complete.
TEST_F(AutoDisplay, ARepeatedlyLostScreenStaysReported) {
    kms_.presence = Presence::Ready;
    run(kSecond);
    ASSERT_EQ(display_->fault(), std::nullopt);
    kms_.refusesAfter = kms_.shown;
    for (int i = 0; i < 100; ++i) {
        run(std::chrono::milliseconds(50));
        ASSERT_THAT(display_->fault().value_or(""), HasSubstr("kms is broken")) << i;
        if (!kms_.held) kms_.refusesAfter = kms_.shown + 2;
    }
    EXPECT_GT(kms_.shown, 30) << "the screen must be tried again and again";
    kms_.refusesAfter = 1000000;
    EXPECT_GE(run(kSecond), 8);
    EXPECT_EQ(display_->fault(), std::nullopt);
}

TEST_F(AutoDisplay, ReleasesARemovedDevice) {
    kms_.presence = Presence::Ready;
    run(kSecond);
    kms_.presence = Presence::Absent;
    EXPECT_EQ(run(kSecond), 0);
    EXPECT_FALSE(kms_.held);
}

TEST_F(AutoDisplay, TriesTheNextDeviceWhenTheFirstPictureIsRefused) {
    kms_.presence = fbdev_.presence = Presence::Ready;
    kms_.refuses = true;
    EXPECT_GE(run(kSecond), 8);
    EXPECT_EQ(display_->name(), "fbdev held (kms missing)");
    EXPECT_FALSE(kms_.held);
}

TEST_F(AutoDisplay, IfADeviceRefusesPicturesTheNextDeviceShowsEveryPicture) {
    kms_.presence = fbdev_.presence = Presence::Ready;
    kms_.refuses = true;
    (void)run(kSecond);
    const int shown = fbdev_.shown;
    const int frames = run(12 * kSecond);
    EXPECT_GT(frames, 0);
    EXPECT_EQ(fbdev_.shown - shown, frames);
    EXPECT_EQ(display_->fault(), std::nullopt);
}

TEST_F(AutoDisplay, TriesTheNextDeviceWhenTheThirdPictureIsRefused) {
    kms_.presence = fbdev_.presence = Presence::Ready;
    kms_.refusesAfter = 2;
    EXPECT_GE(run(kSecond), 8);
    EXPECT_EQ(display_->name(), "fbdev held (kms missing)");
    EXPECT_EQ(kms_.shown, 2);
}

TEST_F(AutoDisplay, TriesTheFirstDeviceAgainIfThereIsNoOther) {
    kms_.presence = Presence::Ready;
    kms_.refuses = true;
    EXPECT_EQ(run(kSecond), 0);
    EXPECT_THAT(display_->name(), HasSubstr("kms is broken"));
    kms_.refuses = false;
    EXPECT_GE(run(kSecond), 8);
}

TEST_F(AutoDisplay, ReleasesTheContextAndKeepsTheScreen) {
    kms_.presence = Screen::Presence::Ready;
    EXPECT_GT(run(std::chrono::seconds(1)), 0);
    display_->releaseGl();
    EXPECT_EQ(kms_.released, 1);
    EXPECT_TRUE(kms_.held);
    const int before = kms_.shown;
    display_->showAgain({}, now_);
    EXPECT_EQ(kms_.shown, before + 1) << "a picture must be shown again in new buffers";
}

TEST_F(AutoDisplay, OpensNothingWhenTheDevicesDoNotExist) {
    if (std::filesystem::exists("/dev/dri/card0") || std::filesystem::exists("/dev/fb0"))
        GTEST_SKIP() << "this machine has a screen";
    for (const char* spec : {"auto", "kms:card0", "kms", "fbdev:/dev/fb0", "fbdev"}) {
        const std::unique_ptr<ScreenDisplay> screen = openScreen(spec);
        EXPECT_NO_THROW(screen->show({}, now_));
        EXPECT_THAT(screen->name(), HasSubstr("no screen yet")) << spec;
        EXPECT_THAT(screen->name(), HasSubstr("/dev/")) << spec;
        EXPECT_FALSE(screenFault(spec));
    }
}

TEST_F(AutoDisplay, InvalidScreenNamesAreRefused) {
    EXPECT_THROW((void)openScreen("kms:card0,17"), std::runtime_error);
    EXPECT_THAT(screenFault("kms:card0,17").value_or(""), HasSubstr("\"17\""));
}

}  // namespace
}  // namespace mfar
