#include "base/thread_priority.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <future>
#include <thread>

namespace mfar {
namespace {

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
