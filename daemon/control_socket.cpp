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
constexpr int kPauseMs = 100;  // where no descriptor is free
constexpr int kWaitingClients = 8;
constexpr std::size_t kMostClients = 16;  // at once
constexpr mode_t kOwnerAndGroup = 0660;

Failure cannotListen(const std::filesystem::path& path, const std::string& why) {
    return {ExitCode::Unavailable, fmt::format("control socket {}: {}", path.string(), why)};
}

int streamSocket() {
    return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

// A socket file outlives its process.
void removeDead(const std::filesystem::path& path, const sockaddr_un& address) {
    struct stat there{};
    if (lstat(path.c_str(), &there) != 0) return;
    if (!S_ISSOCK(there.st_mode)) throw cannotListen(path, "is a file that is no socket");
    const Fd probe(streamSocket(), "socket");
    const auto* generic = reinterpret_cast<const sockaddr*>(&address);
    if (connect(probe.get(), generic, sizeof address) == 0 || errno != ECONNREFUSED)
        throw cannotListen(path, "another process listens there");
    unlink(path.c_str());
}

int listenAt(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.native().size() >= sizeof address.sun_path)
        throw cannotListen(path, fmt::format("the path is longer than {} characters",
                                             sizeof address.sun_path - 1));
    path.native().copy(address.sun_path, path.native().size());
    removeDead(path, address);
    const int fd = streamSocket();
    if (fd < 0) throw cannotListen(path, std::strerror(errno));
    if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        chmod(path.c_str(), kOwnerAndGroup) != 0 || listen(fd, kWaitingClients) != 0) {
        const int error = errno;
        close(fd);
        throw cannotListen(path, std::strerror(error));
    }
    return fd;
}

int millisecondsTo(Timestamp end) {
    return static_cast<int>(std::max<std::int64_t>((end - Timestamp::now()).count(), 0) /
                            1'000'000);
}

}  // namespace

ControlSocket::ControlSocket(std::filesystem::path path, Handler handler, Heartbeats* hearts)
    : path_(std::move(path)), handler_(std::move(handler)), hearts_(hearts),
      operators_(operatorsGroup()), listening_(listenAt(path_), "socket"),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "eventfd"), thread_([this] { serve(); }) {}

ControlSocket::~ControlSocket() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t n = write(stop_.get(), &one, sizeof one);
    thread_.join();
    unlink(path_.c_str());
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
            if (client.isReady && !client.answer) read(client);
        if (heart) heart->rest();  // others have the answer
        for (Client& client : clients)
            if (client.isComplete && !client.answer) answer(client);
        if (heart) heart->beat();
        for (Client& client : clients)
            if (client.isReady && client.answer) send(client);
        std::erase_if(clients, [](const Client& client) {
            return client.isGone || Timestamp::now() >= client.end;
        });
    }
}

// Until a client has something to say, a new one comes or the time of one is over. False at the end
// of this object.
bool ControlSocket::waitFor(std::vector<Client>& clients) {
    std::vector<pollfd> waiting{{stop_.get(), POLLIN, 0}};
    // Others wait in the queue of the socket.
    waiting.push_back({clients.size() < kMostClients ? listening_.get() : -1, POLLIN, 0});
    int timeout = clients.empty() ? -1 : kRequestMs;
    for (const Client& client : clients) {
        const short events = client.answer ? POLLOUT : POLLIN;
        waiting.push_back({client.fd->get(), events, 0});
        timeout = std::min(timeout, millisecondsTo(client.end));
    }
    if (poll(waiting.data(), waiting.size(), timeout) < 0) return true;
    if (waiting[0].revents != 0) return false;
    for (std::size_t i = 0; i < clients.size(); ++i)
        clients[i].isReady = waiting[i + 2].revents != 0;
    return waiting[1].revents == 0 || accept(clients);
}

bool ControlSocket::accept(std::vector<Client>& clients) {
    const int fd = accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd >= 0)
        clients.push_back({std::make_unique<Fd>(fd, "client"),
                           Timestamp::now() + std::chrono::milliseconds(kRequestMs),
                           roleOfPeer(fd, operators_)});
    else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
        // The client stays in the queue, so the socket stays ready: without a pause, this spins.
        return pause();
    return true;
}

// Up to the line end, or to the end of what the client has to say. A request that is too long is
// cut off, which the handler sees at its length.
void ControlSocket::read(Client& client) {
    std::array<char, 1024> part{};
    const ssize_t bytes = recv(client.fd->get(), part.data(), part.size(), 0);
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

// Until something may be free. False at the end of this object.
bool ControlSocket::pause() const {
    pollfd end{stop_.get(), POLLIN, 0};
    return poll(&end, 1, kPauseMs) <= 0;
}

void ControlSocket::answer(Client& client) {
    std::optional<Heartbeat> heart;
    if (hearts_ != nullptr)
        heart.emplace(*hearts_, "control answer", budget::kAnswer, ThreadRole::Helper);
    client.answer = handler_(client.request, client.role);
    client.answer->line += '\n';
    client.end = Timestamp::now() + std::chrono::milliseconds(kAnswerMs);
    client.isReady = true;  // as a rule it takes all at once
}

// As much as the client takes now.
void ControlSocket::send(Client& client) {
    const std::string& line = client.answer->line;
    const std::vector<std::uint8_t>& data = client.answer->data;
    while (client.sent < line.size() + data.size()) {
        const bool isLine = client.sent < line.size();
        const void* from = isLine ? static_cast<const void*>(line.data() + client.sent)
                                  : data.data() + (client.sent - line.size());
        const std::size_t bytes =
            isLine ? line.size() - client.sent : line.size() + data.size() - client.sent;
        const ssize_t sent = ::send(client.fd->get(), from, bytes, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0 && errno == EAGAIN) return;
        if (sent < 0) break;
        client.sent += static_cast<std::size_t>(sent);
    }
    client.isGone = true;
}

}  // namespace mfar
