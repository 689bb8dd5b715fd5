#include "daemon/call_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <gmock/gmock.h>
#include <string>
#include <thread>

namespace mfar {
namespace {

using namespace std::chrono_literals;

TEST(CallQueue, TheThreadThatRunsTheQueueDoesTheCallAndTheCallerGetsTheResult) {
    CallQueue<int> queue;
    int target = 7;
    std::atomic<bool> ended{false};
    std::thread::id doneBy;
    std::thread other([&] {
        while (!ended)
            queue.runAll(target);
    });
    const int got = queue.call(
        [&](int& value) {
            doneBy = std::this_thread::get_id();
            return value++;
        },
        60s);
    EXPECT_EQ(got, 7);
    EXPECT_EQ(doneBy, other.get_id());
    EXPECT_THROW(queue.call([](int&) { throw std::logic_error("no"); }, 60s), std::logic_error);
    ended = true;
    other.join();
    EXPECT_EQ(target, 8);
}

TEST(CallQueue, ACallWakesTheThreadThatRunsTheQueue) {
    int woken = 0, target = 0;
    CallQueue<int> queue([&] { ++woken; });
    EXPECT_THROW(queue.call([](int&) {}, 1ms), std::runtime_error);
    EXPECT_EQ(woken, 1);
    queue.runAll(target);
}

TEST(CallQueue, ACallThatRunsAfterItsTimeoutIsHarmless) {
    CallQueue<std::string> queue;
    EXPECT_THROW(queue.call([](std::string& s) { s = "done"; }, 1ms), std::runtime_error);
    std::string target;
    queue.runAll(target);
    EXPECT_EQ(target, "done");
}

TEST(CallQueue, CallsOnAClosedQueueReturnAtOnce) {
    CallQueue<int> queue;
    constexpr auto kLimit = 60s;
    const auto start = std::chrono::steady_clock::now();
    std::atomic<bool> asked{false};
    std::thread waiting([&] {
        asked = true;
        EXPECT_THAT([&] { queue.call([](int&) {}, kLimit); },
                    testing::ThrowsMessage<std::runtime_error>("mfard is ending"));
    });
    while (!asked)
        std::this_thread::yield();
    queue.close();
    waiting.join();
    EXPECT_THROW(queue.call([](int&) {}, kLimit), std::runtime_error);
    EXPECT_LT(std::chrono::steady_clock::now() - start, kLimit / 2);
}

}  // namespace
}  // namespace mfar
