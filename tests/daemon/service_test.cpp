#include "daemon/service.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <gmock/gmock.h>

namespace mfar {
namespace {

class Manager {
public:
    Manager() : fd_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        const std::string path = (folder_.path() / "notify").string();
        std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
        EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        setenv("NOTIFY_SOCKET", path.c_str(), 1);
    }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;
    ~Manager() {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
            unsetenv(name);
        close(fd_);
    }
    [[nodiscard]] std::string heard() const {
        std::array<char, 1024> text{};
        const ssize_t n = recv(fd_, text.data(), text.size(), MSG_DONTWAIT);
        return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "";
    }

private:
    test::TempFolder folder_;
    int fd_;
};

TEST(Service, SendsValidNotifications) {
    const Manager manager;
    const Service service;
    ASSERT_TRUE(service.listening());
    service.ready("first line\nsecond");
    EXPECT_EQ(manager.heard(), "READY=1\nSTATUS=first line second");
    service.status("30 fps");
    EXPECT_EQ(manager.heard(), "STATUS=30 fps");
    service.reloading();
    EXPECT_THAT(manager.heard(), testing::MatchesRegex("RELOADING=1\nMONOTONIC_USEC=[0-9]+"));
    service.alive();
    EXPECT_EQ(manager.heard(), "WATCHDOG=1");
    service.stopping("ending");
    EXPECT_EQ(manager.heard(), "STOPPING=1\nSTATUS=ending");
}

TEST(Service, NotifiesTheWatchdogTwiceAsOftenAsRequired) {
    const Manager manager;
    EXPECT_EQ(Service().watchdogPeriod(), std::nullopt);
    setenv("WATCHDOG_USEC", "3000000", 1);
    ASSERT_TRUE(Service().watchdogPeriod().has_value());
    EXPECT_DOUBLE_EQ(Service().watchdogPeriod()->count(), 1.5);
    Service().watchdogPatience(6);
    EXPECT_EQ(manager.heard(), "WATCHDOG_USEC=18000000");
    Service().watchdogPatience(1);
    EXPECT_EQ(manager.heard(), "WATCHDOG_USEC=3000000");
    setenv("WATCHDOG_PID", "1", 1);  // the PID of another process
    EXPECT_EQ(Service().watchdogPeriod(), std::nullopt);
    setenv("WATCHDOG_USEC", "soon", 1);
    EXPECT_EQ(Service().watchdogPeriod(), std::nullopt);
}

TEST(Service, WithoutAManagerNothingIsSent) {
    unsetenv("NOTIFY_SOCKET");
    setenv("WATCHDOG_USEC", "3000000", 1);
    const Service service;
    EXPECT_FALSE(service.listening());
    EXPECT_EQ(service.watchdogPeriod(), std::nullopt);
    service.watchdogPatience(6);
    service.ready("nobody");
    unsetenv("WATCHDOG_USEC");
}

}  // namespace
}  // namespace mfar
