#include "daemon/control_socket.h"

#include "base/time.h"
#include "daemon/budgets.h"
#include "daemon/exit_code.h"

#include <fmt/format.h>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

namespace mfar {
namespace {

constexpr int kRequestMs = 2000;
constexpr int kAnswerMs = 5000;
constexpr int kPauseMs = 100;
constexpr int kWaitingClients = 8;
constexpr std::size_t kMostClients = 16;
constexpr std::size_t kMostAnswers = 4;
constexpr mode_t kOwnerAndGroup = 0660;

Failure cannotListen(const std::filesystem::path& path, const std::string& why) {
    return {ExitCode::Unavailable, fmt::format("control socket {}: {}", path.string(), why)};
}

int streamSocket() {
    return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

void removeDead(const std::filesystem::path& path, const sockaddr_un& address) {
    struct stat there{};
    if (lstat(path.c_str(), &there) != 0) return;
    if (!S_ISSOCK(there.st_mode)) throw cannotListen(path, "the path exists and is not a socket");
    const OwnedFd probe = opened(streamSocket(), "socket");
    const auto* generic = reinterpret_cast<const sockaddr*>(&address);
    if (connect(probe.get(), generic, sizeof address) == 0 || errno != ECONNREFUSED)
        throw cannotListen(path, "another process listens there");
    unlink(path.c_str());
}

OwnedFd listenAt(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.native().size() >= sizeof address.sun_path)
        throw cannotListen(path, fmt::format("the path is longer than {} characters",
                                             sizeof address.sun_path - 1));
    path.native().copy(address.sun_path, path.native().size());
    removeDead(path, address);
    OwnedFd fd(streamSocket());
    if (!fd || bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        chmod(path.c_str(), kOwnerAndGroup) != 0 || listen(fd.get(), kWaitingClients) != 0)
        throw cannotListen(path, std::strerror(errno));
    return fd;
}

int millisecondsTo(Timestamp end) {
    return static_cast<int>(std::max<std::int64_t>((end - Timestamp::now()).count(), 0) /
                            1'000'000);
}

}  // namespace

ControlSocket::ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts)
    : path_(std::move(path)), handler_(std::move(handler)), hearts_(hearts),
      operators_(operatorsGroup()), listening_(listenAt(path_)),
      stop_(opened(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "eventfd")),
      answered_(opened(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "eventfd")),
      thread_([this] { serve(); }) {}

ControlSocket::~ControlSocket() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t n = write(stop_.get(), &one, sizeof one);
    thread_.join();
    unlink(path_.c_str());
}

// Waits until `fd` is ready. Returns false after the timeout. While this object is being destroyed,
// does not wait, but still returns true if `fd` is ready. So an answer that is being sent still
// reaches a client that reads it without delay.
bool ControlSocket::isReady(int fd, short events, int timeoutMs) const {
    std::array<pollfd, 2> waiting{{{fd, events, 0}, {stop_.get(), POLLIN, 0}}};
    const Timestamp end = Timestamp::now() + std::chrono::milliseconds(timeoutMs);
    for (int left = timeoutMs;; left = millisecondsTo(end)) {
        const int count = poll(waiting.data(), waiting.size(), left);
        if (count < 0 && errno == EINTR) continue;
        return count > 0 && waiting[0].revents != 0;
    }
}

void ControlSocket::serve() {
    std::vector<Client> clients;
    std::optional<Heartbeat> heart;
    if (hearts_ != nullptr) heart.emplace(*hearts_, "control", budget::kControl);
    const auto waits = [&] {
        if (heart) heart->rest();
        const bool goesOn = waitFor(clients);
        if (heart) heart->beat();
        return goesOn;
    };
    while (waits()) {
        for (Client& client : clients)
            if (client.isReady) read(client);
        startAnswers(clients);
        std::erase_if(clients, [](const Client& client) {
            return client.isGone || (!client.isComplete && Timestamp::now() >= client.end);
        });
    }
    if (heart) heart->rest();
    answers_.clear();
}

void ControlSocket::startAnswers(std::vector<Client>& clients) {
    std::uint64_t drained = 0;
    [[maybe_unused]] const ssize_t n = ::read(answered_.get(), &drained, sizeof drained);
    answers_.remove_if([](const Answering& one) { return one.isOver.load(); });
    for (Client& client : clients) {
        if (!client.isComplete || answers_.size() >= kMostAnswers) continue;
        Answering& one = answers_.emplace_back(std::move(client));
        one.thread = std::jthread([this, &one] { answer(one); });
        client = {};
        client.isGone = true;
    }
}

// Waits for data from a client, a new client, a finished answer, or the time limit of a client.
// Returns false when this object is destroyed.
bool ControlSocket::waitFor(std::vector<Client>& clients) {
    std::vector<pollfd> waiting{{stop_.get(), POLLIN, 0}, {answered_.get(), POLLIN, 0}};
    // While kMostClients clients send a request or wait for an answer thread, further clients wait
    // in the socket's queue.
    waiting.push_back({clients.size() < kMostClients ? listening_.get() : -1, POLLIN, 0});
    int timeout = -1;
    for (const Client& client : clients) {
        // No more data is read from a client whose request is complete. The request waits for a
        // free answer thread.
        waiting.push_back({client.isComplete ? -1 : client.fd.get(), POLLIN, 0});
        if (client.isComplete) continue;
        const int left = millisecondsTo(client.end);
        timeout = timeout < 0 ? left : std::min(timeout, left);
    }
    if (poll(waiting.data(), waiting.size(), timeout) < 0) return true;
    if (waiting[0].revents != 0) return false;
    for (std::size_t i = 0; i < clients.size(); ++i)
        clients[i].isReady = waiting[i + 3].revents != 0;
    return waiting[2].revents == 0 || accept(clients);
}

bool ControlSocket::accept(std::vector<Client>& clients) {
    const int fd = accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd >= 0)
        clients.push_back({OwnedFd(fd), Timestamp::now() + std::chrono::milliseconds(kRequestMs),
                           roleOfPeer(fd, operators_)});
    else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
        // No descriptor or memory is left for a new client. The client stays in the socket's queue,
        // so the next poll() returns at once. The pause prevents a busy loop.
        return !isReady(stop_.get(), POLLIN, kPauseMs);
    return true;
}

// Reads the next part of a client's request. A request is complete at the end of its line, at the
// end of the client's data, or when it is longer than kLongestRequest. The handler refuses a
// request that is too long.
void ControlSocket::read(Client& client) {
    std::array<char, 1024> part{};
    const ssize_t bytes = recv(client.fd.get(), part.data(), part.size(), 0);
    if (bytes < 0) {
        client.isGone = errno != EAGAIN && errno != EINTR;
        return;
    }
    std::string& request = client.request;
    request.append(part.data(), static_cast<std::size_t>(bytes));
    const std::size_t lineEnd = request.find('\n');
    if (lineEnd != request.npos) request.resize(lineEnd);
    const bool isWhole = lineEnd != request.npos || bytes == 0 || request.size() > kLongestRequest;
    client.isComplete = isWhole && !request.empty();
    client.isGone = isWhole && request.empty();
}

void ControlSocket::answer(Answering& one) {
    {
        std::optional<Heartbeat> heart;
        if (hearts_ != nullptr)
            heart.emplace(*hearts_, "control answer", budget::kAnswer, ThreadRole::Helper);
        const int client = one.client.fd.get();
        ControlAnswer answer = handler_(one.client.request, one.client.role);
        answer.line += '\n';
        const Timestamp end = Timestamp::now() + std::chrono::milliseconds(kAnswerMs);
        send(client, answer.line.data(), answer.line.size(), end);
        send(client, answer.data.data(), answer.data.size(), end);
        one.client.fd = OwnedFd();
    }
    one.isOver = true;
    constexpr std::uint64_t kOne = 1;
    [[maybe_unused]] const ssize_t n = write(answered_.get(), &kOne, sizeof kOne);
}

void ControlSocket::send(int client, const void* data, std::size_t bytes, Timestamp end) const {
    const auto* at = static_cast<const std::uint8_t*>(data);
    while (bytes > 0) {
        const int left = millisecondsTo(end);
        if (left <= 0 || !isReady(client, POLLOUT, left)) return;
        const ssize_t sent = ::send(client, at, bytes, MSG_NOSIGNAL);
        if (sent < 0) return;
        at += sent;
        bytes -= static_cast<std::size_t>(sent);
    }
}

}  // namespace mfar
