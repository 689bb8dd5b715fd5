#include "daemon/journal.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <string>

namespace mfar {
namespace {

using Clock = std::chrono::steady_clock;

TEST(Journal, WithoutAJournalNoMessageIsAccepted) {
    const test::TempFolder folder;
    Journal journal((folder / "none").string());
    EXPECT_FALSE(journal({"MESSAGE=lost"}));
}

TEST(Journal, OnlyOneMessageWaitsForAStalledJournal) {
    const test::TempFolder folder;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (folder / "journal").c_str(), sizeof address.sun_path - 1);
    const int reads = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const int fills = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    ASSERT_EQ(bind(reads, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(connect(fills, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    while (send(fills, "x", 1, 0) == 1) {
    }
    Journal journal(address.sun_path);
    const auto begun = Clock::now();
    constexpr int kMessages = 200;  // if each message waited, the loop would take 100 s
    for (int i = 0; i < kMessages; ++i)
        EXPECT_FALSE(journal({"MESSAGE=lost"}));
    EXPECT_LT(Clock::now() - begun, std::chrono::seconds(50));
    close(reads);
    close(fills);
}

}  // namespace
}  // namespace mfar
