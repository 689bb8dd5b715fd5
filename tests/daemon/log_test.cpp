#include "daemon/log.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace mfar {
namespace {

using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

std::string written(Log::Style style, const std::function<void(Log&)>& talk) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return "no pipe";
    Log log(ends[1], style);
    talk(log);
    close(ends[1]);
    std::string all;
    std::array<char, 4096> part{};
    for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;)
        all.append(part.data(), static_cast<std::size_t>(n));
    close(ends[0]);
    return all;
}

void talkMuch(Log& log) {
    log.status("12 fps");
    log.error("broken\nreally");
    log.warning("late");
    log.notice("started");
    log.endStatus();
}

TEST(Log, PlainStyleWritesOnlyMessages) {
    EXPECT_EQ(written(Log::Style::Plain, talkMuch),
              "mfard: error: broken\nmfard: error: really\nmfard: warning: late\n"
              "mfard: started\n");
}

TEST(Log, JournalLinesCarryTheirPriority) {
    EXPECT_EQ(written(Log::Style::Journal, talkMuch),
              "<3>mfard: error: broken\n<3>mfard: error: really\n<4>mfard: warning: late\n"
              "<5>mfard: started\n");
}

TEST(Log, TerminalStyleKeepsTheStatusLineBelowMessages) {
    EXPECT_EQ(written(Log::Style::Terminal,
                      [](Log& log) {
                          log.status("12 fps");
                          log.warning("late");
                          log.endStatus();
                          log.notice("end");
                      }),
              "\r\x1b[K12 fps\r\x1b[Kmfard: warning: late\n12 fps\nmfard: end\n");
}

TEST(Log, StatusLineNeverWraps) {
    const std::string out =
        written(Log::Style::Terminal, [](Log& log) { log.status(std::string(500, 'x')); });
    EXPECT_EQ(out, "\r\x1b[K" + std::string(79, 'x'));
}

TEST(Log, AStatusOfSeveralLinesIsShownInOneLine) {
    const std::string out =
        written(Log::Style::Terminal, [](Log& log) { log.status("video: gone\nstill: gone"); });
    EXPECT_EQ(out, "\r\x1b[Kvideo: gone still: gone");
}

TEST(Log, RepeatedEventsAreLoggedWithTheirCount) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    Timestamp now = Timestamp::fromSeconds(100);
    {
        Log log(ends[1], Log::Style::Journal, [&] { return now; });
        const auto pass = [&](double s) {
            now = Timestamp::fromSeconds(now.seconds() + s);
            log.sayKept();
        };
        for (int i = 0; i < 8; ++i) {
            log.warning("camera: gone");
            now = now + std::chrono::milliseconds(1);
            log.change("all devices are available again");
            log.notice("reloaded");
        }
        pass(9);
        log.warning("hangs for 1 s", "hang");
        log.warning("hangs for 2 s", "hang");
        pass(1);
        log.endStatus();
    }
    close(ends[1]);
    std::string all(4096, ' ');
    const ssize_t n = read(ends[0], all.data(), all.size());
    close(ends[0]);
    ASSERT_GT(n, 0);
    all.resize(static_cast<std::size_t>(n));
    std::string expected =
        "<4>mfard: warning: camera: gone\n<5>mfard: all devices are available again\n";
    for (int i = 0; i < 8; ++i)
        expected += "<5>mfard: reloaded\n";
    EXPECT_EQ(all, expected +
                       "<4>mfard: warning: hangs for 1 s\n"
                       "<4>mfard: warning: camera: gone (repeated 7 times in 10 s)\n"
                       "<5>mfard: all devices are available again (repeated 7 times in 10 s)\n"
                       "<4>mfard: warning: hangs for 2 s (repeated once in 1 s)\n");
}

TEST(Log, TheJournalGetsStructuredFields) {
    std::vector<std::string> sent;
    Timestamp now = Timestamp::fromSeconds(100);
    Log log(
        -1, Log::Style::Journal, [&] { return now; },
        [&](const std::vector<std::string>& fields) {
            sent.insert(sent.end(), fields.begin(), fields.end());
            return true;
        });
    for (int i = 0; i < 3; ++i)
        log.warning("video camera: gone", {}, {message::kDegraded, "video", "video capture"});
    EXPECT_THAT(sent, UnorderedElementsAre("MESSAGE=warning: video camera: gone", "PRIORITY=4",
                                           "SYSLOG_IDENTIFIER=mfard", "MFAR_COUNT=1",
                                           "MFAR_CAMERA=video", "MFAR_THREAD=video capture",
                                           "MESSAGE_ID=" + std::string(message::kDegraded)));
    sent.clear();
    now = now + RepeatLimit::kInterval;
    log.sayKept();
    EXPECT_THAT(sent,
                IsSupersetOf({"MESSAGE=warning: video camera: gone (repeated 2 times in 10 s)",
                              "MFAR_COUNT=2", "MFAR_CAMERA=video"}));
    sent.clear();
    log.notice("first\nsecond");
    EXPECT_THAT(sent, UnorderedElementsAre("MESSAGE=first\nsecond", "PRIORITY=5",
                                           "SYSLOG_IDENTIFIER=mfard", "MFAR_COUNT=1"));
}

TEST(Log, MessagesThatTheJournalRefusesGoToStandardError) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    Log log(ends[1], Log::Style::Journal, &Timestamp::now, [](const auto&) { return false; });
    log.warning("late");
    close(ends[1]);
    std::string all(100, ' ');
    const ssize_t n = read(ends[0], all.data(), all.size());
    close(ends[0]);
    ASSERT_GT(n, 0);
    EXPECT_EQ(all.substr(0, static_cast<std::size_t>(n)), "<4>mfard: warning: late\n");
}

TEST(Log, MessagesThatNobodyReadsDoNotBlockAThread) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK), 0);
    const std::string part(4096, 'x');
    while (write(ends[1], part.data(), part.size()) > 0) {
    }
    fcntl(ends[1], F_SETFL, 0);  // writes to the pipe block from now on
    Log log(ends[1], Log::Style::Plain);
    for (int i = 0; i < 20; ++i)
        log.notice("lost");
    std::string taken(1 << 20, ' ');
    while (read(ends[0], taken.data(), taken.size()) > 0) {
    }
    log.notice("here again");
    const ssize_t n = read(ends[0], taken.data(), taken.size());
    ASSERT_GT(n, 0);
    EXPECT_EQ(
        taken.substr(0, static_cast<std::size_t>(n)),
        "mfard: 20 messages were dropped, because standard error was full\nmfard: here again\n");
    close(ends[0]);
    close(ends[1]);
}

TEST(Log, JournalStyleIsUsedIfStandardErrorIsTheJournalsSocket) {
    const int file = open("/dev/null", O_WRONLY | O_CLOEXEC);
    ASSERT_GE(file, 0);
    struct stat status{};
    ASSERT_EQ(fstat(file, &status), 0);
    const std::string self = fmt::format("{}:{}", status.st_dev, status.st_ino);
    setenv("JOURNAL_STREAM", self.c_str(), 1);
    EXPECT_EQ(Log::styleOf(file), Log::Style::Journal);
    setenv("JOURNAL_STREAM", "1:1", 1);
    EXPECT_EQ(Log::styleOf(file), Log::Style::Plain);
    unsetenv("JOURNAL_STREAM");
    EXPECT_EQ(Log::styleOf(file), Log::Style::Plain);
    close(file);
}

}  // namespace
}  // namespace mfar
