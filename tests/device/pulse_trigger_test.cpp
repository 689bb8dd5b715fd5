#include "hal/device/pulse_trigger.h"

#include <gtest/gtest.h>

#include <deque>
#include <future>
#include <gmock/gmock.h>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using std::chrono::microseconds;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Level {
    bool active;
    Timestamp time;
};

/// A wire from the trigger line to the loopback input. `history`: all levels that were set.
/// `edges`: edges that the input has not fetched yet.
struct Wire {
    std::mutex mutex;
    std::vector<Level> history;
    std::deque<Timestamp> edges;
    std::chrono::nanoseconds clockOffset{0};
    int edgesToLose = 0;
    int setsToFail = 0;
    bool isUnplugged = false;  ///< true: the loopback input cannot be read

    bool active() {
        std::lock_guard lock(mutex);
        return !history.empty() && history.back().active;
    }
    std::vector<Level> all() {
        std::lock_guard lock(mutex);
        return history;
    }
    void set(bool active) {
        std::lock_guard lock(mutex);
        if (setsToFail > 0) {
            --setsToFail;
            throw std::runtime_error("the wire is cut");
        }
        const Timestamp now = Timestamp::now();
        const bool edge = active != (!history.empty() && history.back().active);
        history.push_back({active, now});
        if (!edge) return;
        if (edgesToLose > 0)
            --edgesToLose;
        else
            edges.push_back(now + clockOffset);
    }
    std::optional<Timestamp> edge() {
        std::lock_guard lock(mutex);
        if (isUnplugged) throw std::runtime_error("the loopback input is unplugged");
        if (edges.empty()) return std::nullopt;
        const Timestamp first = edges.front();
        edges.pop_front();
        return first;
    }
};

class WireOutput final : public OutputLine {
public:
    explicit WireOutput(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
    void set(bool active) override { wire_->set(active); }

private:
    std::shared_ptr<Wire> wire_;
};

class WireInput final : public EdgeInput {
public:
    explicit WireInput(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
    std::optional<Timestamp> next(microseconds) override { return wire_->edge(); }

private:
    std::shared_ptr<Wire> wire_;
};

std::unique_ptr<PulseTrigger> triggerOn(const std::shared_ptr<Wire>& wire, microseconds pulse,
                                        bool loopback = false) {
    return std::make_unique<PulseTrigger>("wire", std::make_unique<WireOutput>(wire),
                                          loopback ? std::make_unique<WireInput>(wire) : nullptr,
                                          pulse);
}

void untilInactive(Wire& wire) {
    while (wire.active())
        std::this_thread::sleep_for(100us);
}

TEST(PulseTrigger, LineIsInactiveFromTheStart) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 1ms);
    ASSERT_EQ(wire->all().size(), 1U);
    EXPECT_FALSE(wire->all()[0].active);
}

TEST(PulseTrigger, PulseIsNeverShorterThanRequestedAndItsStartIsTimed) {
    for (const microseconds pulse :
         {microseconds{20}, microseconds{1000}, microseconds{1500}, microseconds{5000}}) {
        const auto wire = std::make_shared<Wire>();
        const auto trigger = triggerOn(wire, pulse);
        const Timestamp before = Timestamp::now();
        const Timestamp edge = trigger->fire();
        untilInactive(*wire);
        const std::vector<Level> levels = wire->all();
        ASSERT_EQ(levels.size(), 3U);
        EXPECT_TRUE(levels[1].active);
        EXPECT_GE(edge, before);
        EXPECT_GE(levels[2].time, edge + pulse) << pulse.count() << " us";
        EXPECT_LE(edge, levels[2].time);
    }
}

TEST(PulseTrigger, LongPulsesDoNotBlockTheCallerAndEndWithTheTrigger) {
    const auto wire = std::make_shared<Wire>();
    auto trigger = triggerOn(wire, 10s);
    const Timestamp edge = trigger->fire();
    EXPECT_TRUE(wire->active());
    trigger.reset();
    EXPECT_FALSE(wire->active());
    EXPECT_LT(wire->all()[2].time, edge + 10s);
}

TEST(PulseTrigger, SecondPulseDuringTheFirstIsRefused) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 10s);
    trigger->fire();
    EXPECT_THROW(trigger->fire(), TriggerBusy);
    EXPECT_EQ(wire->all().size(), 2U) << "a refused pulse must not change the line";
}

TEST(PulseTrigger, FiresAgainOnceThePulseIsOver) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 2ms);
    for (int i = 0; i < 5;) {
        try {
            trigger->fire();
            ++i;
        } catch (const TriggerBusy&) {
            std::this_thread::sleep_for(200us);
        }
    }
    untilInactive(*wire);
    const std::vector<Level> levels = wire->all();
    ASSERT_EQ(levels.size(), 11U);
    for (std::size_t i = 0; i < levels.size(); ++i)
        EXPECT_EQ(levels[i].active, i % 2 == 1) << i;
}

TEST(PulseTrigger, PulseCanBeEndedEarlyAndTheNextHasItsFullLength) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 100ms);
    trigger->fire();
    std::this_thread::sleep_for(50ms);
    trigger->endPulse();
    EXPECT_FALSE(wire->active());
    trigger->fire();
    untilInactive(*wire);
    const std::vector<Level> levels = wire->all();
    EXPECT_GE(levels.back().time - levels[levels.size() - 2].time, 100ms);
    trigger->endPulse();
    EXPECT_EQ(wire->all().size(), levels.size())
        << "endPulse() must not drive a line that is already inactive";
}

TEST(PulseTrigger, LoopbackMeasuresStartAndLength) {
    for (const microseconds pulse : {microseconds{50}, microseconds{3000}}) {
        const auto wire = std::make_shared<Wire>();
        const auto trigger = triggerOn(wire, pulse, true);
        EXPECT_FALSE(trigger->measured());
        wire->edges.push_back(Timestamp::now());  // an edge from a disturbance, before the pulse
        const Timestamp edge = trigger->fire();
        while (!trigger->measured())
            std::this_thread::sleep_for(100us);
        const std::vector<Level> levels = wire->all();
        const MeasuredPulse measured = *trigger->measured();
        EXPECT_EQ(edge, levels[1].time);
        EXPECT_EQ(measured.start, levels[1].time);
        EXPECT_EQ(measured.end, levels[2].time);
        EXPECT_EQ(trigger->missedEdges(), 0U);
    }
}

TEST(PulseTrigger, MissedEdgesOfTheLoopbackAreCounted) {
    for (const int lost : {1, 2}) {
        for (const microseconds pulse : {microseconds{50}, microseconds{3000}}) {
            const auto wire = std::make_shared<Wire>();
            wire->edgesToLose = lost;
            const auto trigger = triggerOn(wire, pulse, true);
            const Timestamp before = Timestamp::now();
            const Timestamp edge = trigger->fire();
            while (trigger->missedEdges() == 0)
                std::this_thread::sleep_for(100us);
            EXPECT_FALSE(trigger->measured());
            const std::vector<Level> levels = wire->all();
            EXPECT_GE(edge, before);
            EXPECT_LT(edge, levels[2].time)
                << "the end of the pulse must not be mistaken for its start";
        }
    }
}

TEST(PulseTrigger, PulsesAreDrivenAndTimedEvenIfTheLoopbackIsUnplugged) {
    for (const microseconds pulse : {microseconds{50}, microseconds{3000}}) {
        const auto wire = std::make_shared<Wire>();
        const auto trigger = triggerOn(wire, pulse, true);
        wire->isUnplugged = true;
        for (std::uint64_t fired = 1; fired <= 2; ++fired) {
            const Timestamp before = Timestamp::now();
            const Timestamp edge = trigger->fire();
            while (trigger->missedEdges() < fired)
                std::this_thread::sleep_for(100us);
            const std::vector<Level> levels = wire->all();
            ASSERT_EQ(levels.size(), 1 + 2 * fired);
            EXPECT_GE(edge, before);
            EXPECT_LT(edge, levels.back().time);
            EXPECT_EQ(trigger->missedEdges(), fired);
        }
        EXPECT_FALSE(trigger->measured());
    }
}

TEST(PulseTrigger, LoopbackTimesOfAnotherClockAreIgnored) {
    const auto wire = std::make_shared<Wire>();
    // The loopback's times come from a clock like CLOCK_REALTIME, which is decades ahead.
    wire->clockOffset = std::chrono::hours(24 * 365 * 50);
    const auto trigger = triggerOn(wire, 50us, true);
    const Timestamp edge = trigger->fire();
    EXPECT_LE(edge, Timestamp::now());
    EXPECT_FALSE(trigger->measured());
    EXPECT_EQ(trigger->missedEdges(), 1U);
}

TEST(PulseTrigger, LineThatCannotBeDrivenIsReported) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 50us);
    wire->setsToFail = 1;
    EXPECT_THAT([&] { trigger->fire(); },
                ThrowsMessage<std::runtime_error>(HasSubstr("the wire is cut")));
    EXPECT_NO_THROW(trigger->fire());
}

TEST(PulseTrigger, PulseThatCouldNotBeEndedIsReportedByTheNextFire) {
    const auto wire = std::make_shared<Wire>();
    const auto trigger = triggerOn(wire, 20ms);
    trigger->fire();
    {
        std::lock_guard lock(wire->mutex);
        wire->setsToFail = 1;
    }
    std::string fault;
    while (fault.empty()) {
        try {
            trigger->fire();
            FAIL() << "fire() must fail until it has reported that the pulse could not be ended";
        } catch (const TriggerBusy&) {
            std::this_thread::sleep_for(1ms);
        } catch (const std::runtime_error& error) {
            fault = error.what();
        }
    }
    EXPECT_THAT(fault, HasSubstr("the wire is cut"));
}

TEST(PulseTrigger, ImpossibleLengthsAreRefused) {
    for (const microseconds pulse : {microseconds{0}, microseconds{-1}, microseconds{10'000'001}})
        EXPECT_THAT([&] { (void)triggerOn(std::make_shared<Wire>(), pulse); },
                    ThrowsMessage<std::runtime_error>(HasSubstr("1 us to 10 s")));
}

}  // namespace
}  // namespace mfar
