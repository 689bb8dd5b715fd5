#include "base/owned_fd.h"
#include "daemon/events.h"

#include <gtest/gtest.h>

#include <signal.h>
#include <unistd.h>

#include <thread>

namespace mfar {
namespace {

using std::chrono::milliseconds;

TEST(Events, AnotherThreadCanWakeTheWaitingThread) {
    Events events;
    std::jthread other([&] { events.wake(); });
    EXPECT_EQ(events.wait().kind, Event::Kind::Wake);
}

TEST(Events, SignalsHaveTheirNumberAndComeBeforeWakeEvents) {
    Events events;
    events.wake();
    kill(getpid(), SIGHUP);
    const Event first = events.wait();
    EXPECT_EQ(first.kind, Event::Kind::Signal);
    EXPECT_EQ(first.signal, SIGHUP);
    EXPECT_EQ(events.wait().kind, Event::Kind::Wake);
}

TEST(Events, SignalsEndTheProcessWhileSignalsEndProcessExists) {
    Events events;
    EXPECT_EXIT(
        {
            const SignalsEndProcess now;
            kill(getpid(), SIGTERM);
        },
        testing::KilledBySignal(SIGTERM), "");
    {
        const SignalsEndProcess before;
    }
    kill(getpid(), SIGTERM);
    EXPECT_EQ(events.wait().signal, SIGTERM);
}

TEST(Events, TicksRepeatAndADeadlineExpiresOnce) {
    Events events;
    events.deadlineIn(milliseconds(1));
    EXPECT_EQ(events.wait().kind, Event::Kind::Deadline);
    events.tickEvery(milliseconds(1));
    EXPECT_EQ(events.wait().kind, Event::Kind::Tick);
    EXPECT_EQ(events.wait().kind, Event::Kind::Tick);
}

TEST(Events, ANewDeadlineReplacesTheOldOne) {
    Events events;
    events.deadlineIn(std::chrono::hours(1));
    events.deadlineIn(milliseconds(1));
    EXPECT_EQ(events.wait().kind, Event::Kind::Deadline);
}

TEST(OwnedFd, InvalidDescriptorsAreRefused) {
    EXPECT_THROW((void)opened(-1, "thing"), std::system_error);
}

}  // namespace
}  // namespace mfar
