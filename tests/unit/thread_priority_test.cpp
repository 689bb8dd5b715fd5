#include "base/thread_priority.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>
#include <thread>

namespace mfar {
namespace {

// mfard itself may run at a low priority. A fixed nice value could then raise the thread's
// priority, which most users may not do.
TEST(ThreadPriority, IsLoweredRelativeToThePriorityBefore) {
    const auto loweredFrom = [](int nice) {
        int out = 0;
        std::jthread([&] {
            const auto id = static_cast<id_t>(gettid());
            EXPECT_EQ(setpriority(PRIO_PROCESS, id, nice), 0);
            EXPECT_TRUE(lowerThreadPriority());
            out = getpriority(PRIO_PROCESS, id);
        }).join();
        return out;
    };
    const int own = getpriority(PRIO_PROCESS, 0);
    EXPECT_EQ(loweredFrom(std::min(own + 2, 19)), std::min(own + 12, 19));
    EXPECT_EQ(loweredFrom(std::min(own + 12, 19)), 19);
}

TEST(ThreadPriority, IsRaisedForThreadsThatLoweredIt) {
    ASSERT_TRUE(lowerThreadPriority());
    if (setpriority(PRIO_PROCESS, 0, 0) != 0) GTEST_SKIP() << "this user may not raise priorities";
    std::promise<id_t> lowered;
    std::promise<void> end;
    const std::jthread thread([&] {
        lowerThreadPriority();
        lowered.set_value(static_cast<id_t>(gettid()));
        end.get_future().wait();
    });
    const id_t id = lowered.get_future().get();
    EXPECT_EQ(getpriority(PRIO_PROCESS, id), 10);
    raiseThreadPriorities();
    EXPECT_EQ(getpriority(PRIO_PROCESS, id), 0);
    end.set_value();
}

}  // namespace
}  // namespace mfar
