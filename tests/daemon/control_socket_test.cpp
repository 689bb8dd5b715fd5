#include "daemon/control_socket.h"
#include "daemon/exit_code.h"
#include "daemon/tools/control_client.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <future>
#include <gmock/gmock.h>
#include <grp.h>
#include <thread>
#include <vector>

namespace mfar {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A server that waited for one client after another would take longer than this, because it waits
/// two seconds for a request and five seconds for the reader of an answer.
constexpr std::chrono::seconds kOneAfterAnother{4};

struct ControlSocketTest : testing::Test {
    void SetUp() override {
        std::string name =
            (std::filesystem::temp_directory_path() / "mfar-control.XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
        path = folder / "control";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    [[nodiscard]] int connected() const {
        const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.native().copy(address.sun_path, sizeof address.sun_path - 1);
        EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        return fd;
    }
    static double processSeconds() {
        timespec used{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
        return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
    }
    static ControlAnswer echo(std::string_view request, ControlRole /*role*/) {
        return {json{{"ok", true}, {"length", request.size()}}.dump()};
    }

    std::filesystem::path folder, path;
};

TEST_F(ControlSocketTest, AnAnswerConsistsOfALineAndItsData) {
    std::vector<std::uint8_t> data(3'000'000);
    for (std::size_t i = 0; i < data.size(); ++i)
        data[i] = static_cast<std::uint8_t>(i * 7);
    std::string heard;
    const ControlSocket socket(path, [&](std::string_view request, ControlRole) -> ControlAnswer {
        heard = request;
        return {json{{"ok", true}, {"bytes", data.size()}}.dump(), data};
    });
    const Reply reply = ask(path, {{"command", "snapshot"}});
    EXPECT_EQ(heard, R"({"command":"snapshot"})");
    EXPECT_EQ(reply.data, data);
}

TEST_F(ControlSocketTest, OnlyOwnerAndGroupMayUseTheSocket) {
    const ControlSocket socket(path, echo);
    struct stat there{};
    ASSERT_EQ(stat(path.c_str(), &there), 0);
    EXPECT_EQ(there.st_mode & 07777U, 0660U);
}

TEST_F(ControlSocketTest, EndlessRequestIsCutOff) {
    const ControlSocket socket(path, echo);
    const int client = connected();
    const std::string flood(1'000'000, 'x');
    std::ignore = send(client, flood.data(), flood.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    std::string answer(200, '\0');
    const ssize_t got = recv(client, answer.data(), answer.size(), 0);
    ASSERT_GT(got, 0);
    answer.resize(static_cast<std::size_t>(got));
    const auto length = json::parse(answer)["length"].get<std::size_t>();
    EXPECT_GT(length, ControlSocket::kLongestRequest);
    EXPECT_LT(length, 2 * ControlSocket::kLongestRequest);
    close(client);
}

TEST_F(ControlSocketTest, DisconnectedAndIncompleteClientsAreHarmless) {
    const ControlSocket socket(path, echo);
    close(connected());
    const int half = connected();
    EXPECT_EQ(send(half, "{", 1, MSG_NOSIGNAL), 1);
    EXPECT_EQ(ask(path, {{"command", "status"}}).body["length"], 20);
    close(half);
}

TEST_F(ControlSocketTest, SilentClientsDelayNobody) {
    const ControlSocket socket(path, echo);
    const std::array<int, 3> idle{connected(), connected(), connected()};
    const Timestamp begun = Timestamp::now();
    EXPECT_EQ(ask(path, {{"command", "status"}}).body["length"], 20);
    EXPECT_LT(Timestamp::now() - begun, kOneAfterAnother);
    for (const int fd : idle)
        close(fd);
}

TEST_F(ControlSocketTest, SlowAnswersDelayNobody) {
    std::promise<void> goOn;
    const std::shared_future<void> gone = goOn.get_future().share();
    std::promise<void> asked;
    const ControlSocket socket(path, [&](std::string_view request, ControlRole role) {
        if (request.find("slow") == request.npos) return echo(request, role);
        asked.set_value();
        gone.wait();
        return echo(request, role);
    });
    const auto slow =
        std::async(std::launch::async, [&] { return ask(path, {{"command", "slow"}}); });
    asked.get_future().wait();
    EXPECT_EQ(ask(path, {{"command", "status"}}).body["length"], 20);
    EXPECT_EQ(slow.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
    goOn.set_value();
    slow.wait();
}

TEST_F(ControlSocketTest, ClientsThatReadNothingDelayNobody) {
    const ControlSocket socket(path, [&](std::string_view request, ControlRole) -> ControlAnswer {
        if (request != "large") return echo(request, ControlRole::Operator);
        return {json{{"ok", true}}.dump(), std::vector<std::uint8_t>(10'000'000)};
    });
    const int greedy = connected();
    EXPECT_EQ(send(greedy, "large\n", 6, MSG_NOSIGNAL), 6);
    char first = 0;
    EXPECT_EQ(recv(greedy, &first, 1, 0),
              1);  // once a byte has arrived, the server is sending the answer
    const Timestamp begun = Timestamp::now();
    EXPECT_EQ(ask(path, {{"command", "status"}}).body["length"], 20);
    EXPECT_LT(Timestamp::now() - begun, kOneAfterAnother);
    close(greedy);
}

TEST_F(ControlSocketTest, AnAnswerThatBecomesReadyWhileTheSocketClosesIsSent) {
    std::promise<void> asked;
    std::promise<void> closes;
    auto socket = std::make_unique<ControlSocket>(
        path, [&](std::string_view request, ControlRole role) -> ControlAnswer {
            asked.set_value();
            closes.get_future().wait();
            // Gives the destructor time to begin its wait for this answer.
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            return echo(request, role);
        });
    auto reply = std::async(std::launch::async, [&] { return ask(path, {{"command", "x"}}); });
    asked.get_future().wait();
    closes.set_value();
    socket.reset();
    EXPECT_NO_THROW((void)reply.get());
}

TEST_F(ControlSocketTest, TheUserOfThisProcessIsAnOperator) {
    std::optional<ControlRole> seen;
    const ControlSocket socket(path, [&](std::string_view request, ControlRole role) {
        seen = role;
        return echo(request, role);
    });
    std::ignore = ask(path, {{"command", "status"}});
    EXPECT_EQ(seen, ControlRole::Operator);
}

// The child process connects as a user who is neither root nor in the operators' group. Mode 0666
// of the socket allows this.
TEST_F(ControlSocketTest, AnotherUserIsAnObserver) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    const ControlSocket socket(path, [&](std::string_view, ControlRole role) -> ControlAnswer {
        return {json{{"ok", true}, {"operator", role == ControlRole::Operator}}.dump()};
    });
    ASSERT_EQ(chmod(path.c_str(), 0666), 0);
    ASSERT_EQ(chmod(folder.c_str(), 0755), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        // This child process must not take a lock. If another thread held it during fork(), nobody
        // would release it.
        if (setgroups(0, nullptr) != 0 || setgid(1234) != 0 || setuid(1234) != 0) _exit(2);
        const int fd = connected();
        char answer[64] = {};
        if (send(fd, "x\n", 2, MSG_NOSIGNAL) != 2) _exit(3);
        if (recv(fd, answer, sizeof answer - 1, 0) <= 0) _exit(4);
        _exit(std::string_view(answer).find("false") != std::string_view::npos ? 0 : 5);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

// The child process asks as a user who may not use the socket. This process has no other thread, so
// the child may allocate memory.
TEST_F(ControlSocketTest, TheErrorForAUserWithoutPermissionNamesARemedy) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    const group* owner = getgrgid(1);
    const std::string name = owner != nullptr ? owner->gr_name : "1";
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(chmod(path.c_str(), 0660), 0);
    ASSERT_EQ(chmod(folder.c_str(), 0755), 0);
    for (const auto& [group, remedy] :
         {std::pair(gid_t{1}, "root or in group " + name),
          std::pair(gid_t{0}, std::string("as root, e.g. with sudo"))}) {
        ASSERT_EQ(chown(path.c_str(), 0, group), 0);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            if (setgroups(0, nullptr) != 0 || setgid(1234) != 0 || setuid(1234) != 0) _exit(2);
            try {
                (void)ask(path, {{"command", "status"}});
            } catch (const NotReachable& error) {
                _exit(std::string_view(error.what()).ends_with(remedy) ? 0 : 3);
            }
            _exit(4);
        }
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 0);
    }
    close(fd);
}

TEST(ControlRole, MembersOfTheGroupAreOperators) {
    const gid_t groups[] = {100, 200};
    EXPECT_EQ(roleOf(0, {}, std::nullopt), ControlRole::Operator);
    EXPECT_EQ(roleOf(geteuid(), {}, std::nullopt), ControlRole::Operator);
    EXPECT_EQ(roleOf(4321, groups, 200), ControlRole::Operator);
    EXPECT_EQ(roleOf(4321, groups, 300), ControlRole::Observer);
    EXPECT_EQ(roleOf(4321, groups, std::nullopt), ControlRole::Observer);
}

// The server must pause between its attempts to accept a client, or it would occupy a processor.
TEST_F(ControlSocketTest, WithoutAFreeDescriptorClientsWait) {
    const ControlSocket socket(path, echo);
    std::vector<int> all{connected()};
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const int waiting = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit tight{static_cast<rlim_t>(waiting) + 1, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &tight), 0);
    for (int fd = dup(0); fd >= 0; fd = dup(0))
        all.push_back(fd);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(connect(waiting, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const double cpu = processSeconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_LT(processSeconds() - cpu, 0.25);
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
    for (const int fd : all)
        close(fd);
    EXPECT_EQ(send(waiting, "status\n", 7, MSG_NOSIGNAL), 7);
    std::string answer(200, '\0');
    EXPECT_GT(recv(waiting, answer.data(), answer.size(), 0), 0);
    close(waiting);
}

TEST_F(ControlSocketTest, OnlyTheSocketOfADeadProcessIsReplaced) {
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    close(fd);
    {
        const ControlSocket socket(path, echo);
        EXPECT_THAT([&] { ControlSocket(path, echo); },
                    ThrowsMessage<Failure>(HasSubstr("another process listens")));
        EXPECT_EQ(ask(path, {{"command", "status"}}).body["length"], 20);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(ControlSocketTest, UnusablePathsAreReported) {
    std::ofstream(folder / "file") << "important";
    EXPECT_THAT([&] { ControlSocket(folder / "file", echo); },
                ThrowsMessage<Failure>(HasSubstr("not a socket")));
    EXPECT_TRUE(std::filesystem::exists(folder / "file"));
    EXPECT_THAT([&] { ControlSocket(folder / "none" / "control", echo); },
                ThrowsMessage<Failure>(HasSubstr("No such file")));
    EXPECT_THAT([&] { ControlSocket(folder / std::string(120, 'a'), echo); },
                ThrowsMessage<Failure>(HasSubstr("longer than")));
}

TEST_F(ControlSocketTest, ClientReportsErrors) {
    EXPECT_THAT([&] { std::ignore = ask(path, {{"command", "status"}}); },
                ThrowsMessage<NotReachable>(HasSubstr("no mfard listens there")));
    const ControlSocket refusing(path, [](std::string_view, ControlRole) {
        return ControlAnswer{R"({"ok": false, "error": "not today"})"};
    });
    EXPECT_THAT([&] { std::ignore = ask(path, {{"command", "status"}}); },
                ThrowsMessage<Refused>(HasSubstr("not today")));
    const ControlSocket babbling(
        folder / "other", [](std::string_view, ControlRole) { return ControlAnswer{"hello"}; });
    EXPECT_THAT([&] { std::ignore = ask(folder / "other", {{"command", "status"}}); },
                ThrowsMessage<NotReachable>(HasSubstr("is not mfard")));
    const ControlSocket lying(folder / "lying", [](std::string_view, ControlRole) {
        return ControlAnswer{R"({"ok": true, "bytes": 1000})", {1, 2, 3}};
    });
    EXPECT_THAT([&] { std::ignore = ask(folder / "lying", {{"command", "snapshot"}}); },
                ThrowsMessage<NotReachable>(HasSubstr("before its answer was complete")));
}

}  // namespace
}  // namespace mfar
