#include "daemon/budgets.h"
#include "daemon/health.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct HealthTest : testing::Test {
    [[nodiscard]] Health look() {
        Observed seen{now};
        seen.late = hearts.late(patience);
        seen.waiting = hearts.waiting();
        seen.fault = fault;
        seen.display = display;
        seen.repeats = repeats;
        seen.lastPicture = picture;
        seen.lastExcuse = excuse;
        seen.started = started;
        seen.patience = patience;
        return record.judge(seen);
    }
    void pass(milliseconds time) { now = now + time; }

    Timestamp now = Timestamp::fromSeconds(100);
    Heartbeats hearts{[this] { return now; }};
    HealthRecord record;
    int patience = 1;
    std::optional<std::string> fault, display;
    std::optional<Timestamp> repeats, picture, excuse, started = now;
};

TEST_F(HealthTest, WithFreshPicturesTheStateIsOk) {
    picture = now;
    pass(seconds(2));
    const Health health = look();
    EXPECT_EQ(health.state, HealthState::Ok);
    EXPECT_EQ(sentence(health), "ok");
    EXPECT_NEAR(health.pictureAgeS.value(), 2, 1e-6);
    EXPECT_TRUE(health.isAlive());
}

TEST_F(HealthTest, AFrozenPictureIsReportedAsDegraded) {
    repeats = now;
    pass(seconds(4));
    picture = now;
    const Health health = look();
    EXPECT_EQ(health.state, HealthState::Degraded);
    EXPECT_EQ(health.cause, "video camera: repeats the same picture");
    EXPECT_NEAR(health.sinceS, 4, 1e-6);
    EXPECT_TRUE(health.isAlive());
}

TEST_F(HealthTest, MfardIsNotAliveWhileADriverHangsEvenIfItDrawsTheBanner) {
    const Heartbeat capture(hearts, "capture", budget::kCapture);
    picture = now;
    pass(seconds(5));
    fault = "video camera: sends no pictures";
    excuse = now;
    const Health health = look();
    EXPECT_FALSE(health.isAlive());
    EXPECT_EQ(health.thread, "capture");
    EXPECT_EQ(sentence(health),
              "the capture thread hangs (stalled for 5.0 s, last picture 5.0 s ago)");
}

TEST_F(HealthTest, AWaitForAKnownReasonIsNoFault) {
    Heartbeat pictures(hearts, "picture", budget::kPicture);
    pictures.rest();
    picture = now;
    for (int s = 0; s < 60; ++s) {
        pass(seconds(1));
        excuse = now;
        ASSERT_EQ(look().state, HealthState::Ok) << s;
    }
    pass(seconds(4));
    EXPECT_EQ(look().state, HealthState::Stalled);
}

TEST_F(HealthTest, MfardIsAliveWhileItDrawsTheBannerForAMissingDevice) {
    Heartbeat capture(hearts, "capture", budget::kCapture);
    fault = "video camera: is not there";
    for (int s = 0; s < 3600; ++s) {
        pass(seconds(1));
        capture.beat();
        excuse = now;
        ASSERT_TRUE(look().isAlive()) << s;
    }
    EXPECT_EQ(look().state, HealthState::Degraded);
    EXPECT_TRUE(look().isDevice);
    EXPECT_EQ(sentence(look()), "video camera: is not there (degraded for 3599.0 s)");
}

TEST_F(HealthTest, WithoutPicturesMfardIsAliveOnlyIfItHasJustDrawnABannerForAFault) {
    pass(kStalePicture + milliseconds(1));
    EXPECT_FALSE(look().isAlive());
    EXPECT_EQ(look().cause, "no new picture");
    fault = "video camera: is not there";
    excuse = now;
    EXPECT_TRUE(look().isAlive());
    fault.reset();
    pass(kStalePicture / 2);
    EXPECT_EQ(look().state, HealthState::Ok)
        << "after the device has returned, its first picture may take some time";
    pass(kStalePicture);
    EXPECT_FALSE(look().isAlive());
    fault = "video camera: is not there";
    EXPECT_FALSE(look().isAlive())
        << "mfard must not count as alive if it no longer draws the banner";
}

TEST_F(HealthTest, TheFirstPictureMayTakeLongerThanLaterPictures) {
    Heartbeat drawing(hearts, "picture", budget::kPicture);
    patience = kFirstPatience;
    pass(5 * budget::kPicture);
    EXPECT_TRUE(look().isAlive())
        << "the first picture may take longer, because shaders are compiled";
    pass(kFirstPatience * kStalePicture);
    EXPECT_FALSE(look().isAlive());
    EXPECT_EQ(look().thread, "picture");
    drawing.beat();
    picture = now;
    EXPECT_EQ(look().state, HealthState::Ok);
}

TEST_F(HealthTest, AHangingHelperThreadIsReportedAndMfardStaysAlive) {
    const Heartbeat reload(hearts, "reload", budget::kReload, ThreadRole::Helper);
    pass(2 * budget::kReload);
    picture = now;
    EXPECT_EQ(look().state, HealthState::Degraded);
    EXPECT_TRUE(look().isAlive());
    EXPECT_EQ(look().thread, "reload");
    EXPECT_EQ(look().cause, "the reload thread hangs");
}

TEST_F(HealthTest, WaitingForTheReaderOfAPipeIsReported) {
    Heartbeat drawing(hearts, "picture", budget::kPicture);
    drawing.restFor("the reader of the pipe");
    picture = now;
    EXPECT_EQ(look().state, HealthState::Ok);
    pass(seconds(2));
    EXPECT_EQ(sentence(look()),
              "waiting for the reader of the pipe (degraded for 2.0 s, last picture 2.0 s ago)");
    pass(seconds(2));
    EXPECT_EQ(look().cause, "waiting for the reader of the pipe");
    EXPECT_EQ(look().state, HealthState::Stalled);
}

TEST_F(HealthTest, ADisplayThatSkipsPicturesIsReportedAsDegraded) {
    picture = now;
    display = "y4m:pipe: the reader of the pipe accepts no data";
    (void)look();
    pass(seconds(1));
    EXPECT_EQ(look().state, HealthState::Degraded);
    EXPECT_NEAR(look().sinceS, 1, 1e-6);
    display.reset();
    EXPECT_EQ(look().state, HealthState::Ok);
    EXPECT_NEAR(look().sinceS, 0, 1e-6) << "the time in the new state must start at 0";
}

TEST_F(HealthTest, EveryCauseOfADegradedStateIsReported) {
    const Heartbeat recorder(hearts, "recorder", budget::kWriter, ThreadRole::Helper);
    pass(2 * budget::kWriter);
    picture = excuse = now;
    fault = "video camera: is not there";
    display = "no screen yet";
    EXPECT_EQ(look().cause, "video camera: is not there; no screen yet; the recorder thread hangs");
    EXPECT_EQ(look().state, HealthState::Degraded);
    EXPECT_EQ(look().thread, "recorder");
    EXPECT_TRUE(look().isDevice);
    pass(seconds(1));
    EXPECT_NEAR(look().sinceS, 1, 1e-6);
}

TEST_F(HealthTest, SlowCameraIsNotAFault) {
    picture = now;
    pass(seconds(10));
    Observed seen{now};
    seen.lastPicture = picture;
    seen.rateHz = 0.2;
    EXPECT_EQ(record.judge(seen).state, HealthState::Ok);
    seen.rateHz = 30;
    EXPECT_EQ(record.judge(seen).state, HealthState::Stalled);
}

TEST_F(HealthTest, JsonHasEveryField) {
    const Heartbeat capture(hearts, "capture", budget::kCapture);
    picture = now;
    auto json = healthJson(look());
    EXPECT_EQ(json["state"], "ok");
    EXPECT_TRUE(json["cause"].is_null());
    EXPECT_TRUE(json["thread"].is_null());
    pass(seconds(4));
    json = healthJson(look());
    EXPECT_EQ(json["state"], "stalled");
    EXPECT_EQ(json["cause"], "the capture thread hangs");
    EXPECT_EQ(json["thread"], "capture");
    EXPECT_NEAR(json["since_s"].get<double>(), 4, 1e-6);
    EXPECT_NEAR(json["picture_age_s"].get<double>(), 4, 1e-6);
}

}  // namespace
}  // namespace mfar
