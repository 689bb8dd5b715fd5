#include "daemon/restart_pause.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace mfar {
namespace {

using std::chrono::seconds;

struct RestartPauseTest : testing::Test {
    RestartPause::Next fail(seconds ran = seconds(1)) {
        const Timestamp started = now;
        now = now + ran;
        const RestartPause::Next next = RestartPause(file).failed(started, now);
        now = now + next.wait + seconds(1);  // RestartSec= of the service adds 1 s
        return next;
    }

    test::TempFolder folder;
    std::filesystem::path file = folder.path() / "restarts";
    Timestamp now = Timestamp::fromSeconds(5000);
};

TEST_F(RestartPauseTest, PausesGrowUpToALimit) {
    for (const int expected : {0, 1, 3, 7, 15, 30, 30, 30})
        EXPECT_EQ(fail().wait.count(), expected);
    EXPECT_EQ(fail().inARow, 9);
}

TEST_F(RestartPauseTest, ADayOfFailuresCausesFewRestarts) {
    const Timestamp end = now + std::chrono::hours(24);
    int restarts = 0;
    while (now < end) {
        (void)fail();
        ++restarts;
    }
    EXPECT_LT(restarts, 3000) << "without growing pauses there would be 43200 restarts";
}

TEST_F(RestartPauseTest, ALongRunResetsTheCountOfFailures) {
    for (int i = 0; i < 4; ++i)
        (void)fail();
    EXPECT_EQ(fail(seconds(61)).wait.count(), 0);
    EXPECT_EQ(fail().wait.count(), 1) << "after a long run, the count of failures must start again";
}

TEST_F(RestartPauseTest, OldFailuresDoNotCount) {
    for (int i = 0; i < 4; ++i)
        (void)fail();
    now = now + seconds(61);
    EXPECT_EQ(fail().inARow, 1);
}

TEST_F(RestartPauseTest, FailureBeforeTheLastBootDoesNotCount) {
    for (int i = 0; i < 4; ++i)
        (void)fail();
    now = Timestamp::fromSeconds(20);
    EXPECT_EQ(fail().inARow, 1);
}

TEST_F(RestartPauseTest, ADamagedStateFileCountsAsMissing) {
    for (const char* text : {"", "x", "-5 1", "2000000000 5000000000000", "3"}) {
        std::ofstream(file) << text;
        EXPECT_EQ(fail().wait.count(), 0) << text;
    }
}

TEST_F(RestartPauseTest, WithoutAWritableStateFileEveryPauseIsTheSame) {
    for (const std::filesystem::path& none : {folder.path() / "gone" / "restarts", {}}) {
        file = none;
        EXPECT_EQ(fail().wait.count(), 5);
        EXPECT_EQ(fail().wait.count(), 5);
    }
}

TEST(Restart, MfardIsNotRestartedAfterSuccessOrErrorsOfConfigurationOrInput) {
    for (const ExitCode code : {ExitCode::Unavailable, ExitCode::OutputFailed, ExitCode::Internal})
        EXPECT_TRUE(isRestarted(code));
    for (const ExitCode code :
         {ExitCode::Ok, ExitCode::Usage, ExitCode::BadData, ExitCode::NoInput, ExitCode::BadConfig})
        EXPECT_FALSE(isRestarted(code));
}

}  // namespace
}  // namespace mfar
