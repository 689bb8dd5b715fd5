#include "daemon/last_resort.h"

#include <gtest/gtest.h>

#include <future>

namespace mfar {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LastResort, RunsItsActionWhenShutdownHangs) {
    std::promise<void> acted;
    LastResort last;
    last.arm(milliseconds(1), [&] { acted.set_value(); });
    EXPECT_EQ(acted.get_future().wait_for(seconds(60)), std::future_status::ready);
}

TEST(LastResort, DoesNothingOnceShutdownIsOver) {
    bool acted = false;
    {
        LastResort last;
        last.arm(hours(1), [&] { acted = true; });
        last.arm(milliseconds(0), [&] { acted = true; });
    }
    EXPECT_FALSE(acted) << "the destructor must cancel the timer without waiting";
}

}  // namespace
}  // namespace mfar
