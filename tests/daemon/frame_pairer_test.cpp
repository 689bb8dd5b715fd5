#include "daemon/capture.h"

#include <gtest/gtest.h>

#include <deque>

namespace mfar {
namespace {

Frame frame(double s) {
    return {ImageView{}, Timestamp::fromSeconds(s), nullptr};
}

class Stills {
public:
    explicit Stills(std::initializer_list<double> times) : times_(times) {}

    FramePairer::NextStill source() {
        return [this]() -> std::optional<CapturedStill> {
            if (times_.empty()) return std::nullopt;
            const double time = times_.front();
            times_.pop_front();
            return CapturedStill{frame(time)};
        };
    }
    void add(double time) { times_.push_back(time); }

private:
    std::deque<double> times_;
};

std::optional<double> stillTime(const CapturedFrame& captured) {
    if (!captured.still) return std::nullopt;
    return captured.still->frame.time().seconds();
}

TEST(FramePairer, WithoutAStillThereIsNoPair) {
    Stills stills({});
    FramePairer pairer(stills.source());
    const CapturedFrame captured = pairer.pair(frame(1), Timestamp{5});
    EXPECT_FALSE(captured.still);
    EXPECT_EQ(captured.video.time(), Timestamp::fromSeconds(1));
    EXPECT_EQ(captured.arrived, Timestamp{5});
}

TEST(FramePairer, AStillIsPairedWithTheFirstFrameThatIsNotOlder) {
    Stills stills({2});
    FramePairer pairer(stills.source());
    EXPECT_EQ(stillTime(pairer.pair(frame(1), {})), std::nullopt);
    EXPECT_EQ(stillTime(pairer.pair(frame(2), {})), 2)
        << "a still and a frame of the same time belong together";
    EXPECT_EQ(stillTime(pairer.pair(frame(3), {})), std::nullopt)
        << "each still is paired with only one frame";
}

TEST(FramePairer, AFrameIsPairedWithTheNewestOfSeveralStills) {
    Stills stills({1, 2, 3, 9});
    FramePairer pairer(stills.source());
    EXPECT_EQ(stillTime(pairer.pair(frame(4), {})), 3);
    EXPECT_EQ(stillTime(pairer.pair(frame(10), {})), 9);
}

TEST(FramePairer, AStillThatComesLateIsNotLost) {
    Stills stills({});
    FramePairer pairer(stills.source());
    EXPECT_EQ(stillTime(pairer.pair(frame(1), {})), std::nullopt);
    stills.add(0.5);
    EXPECT_EQ(stillTime(pairer.pair(frame(2), {})), 0.5);
}

Pose withTags(int tags) {
    Pose pose;
    pose.tags = tags;
    return pose;
}

TEST(CapturedFrame, TheStillOfADroppedFrameGoesToTheNextFrame) {
    CapturedFrame older{frame(1), CapturedStill{frame(0.5), withTags(3)}, {}};
    CapturedFrame newer{frame(2), std::nullopt, {}};
    newer.supersede(std::move(older));
    EXPECT_EQ(stillTime(newer), 0.5);
    EXPECT_EQ(newer.still->pose.value().tags, 3) << "the still must keep its own pose";
    EXPECT_FALSE(newer.pose) << "the still's pose must not become the frame's";
    CapturedFrame newest{frame(3), CapturedStill{frame(2.5), withTags(1)}, {}};
    newest.supersede(std::move(newer));
    EXPECT_EQ(stillTime(newest), 2.5) << "of two stills, the newer one must be kept";
    EXPECT_EQ(newest.still->pose.value().tags, 1) << "the newer still must keep its own pose";
}

}  // namespace
}  // namespace mfar
