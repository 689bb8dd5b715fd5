#include "daemon/control_socket.h"

#include "base/time.h"
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
#include <utility>

namespace mfar {
namespace {

constexpr int kRequestMs = 2000;
constexpr int kAnswerMs = 5000;
constexpr int kWaitingClients = 8;
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

}  // namespace

ControlSocket::ControlSocket(std::filesystem::path path, Handler handler)
    : path_(std::move(path)), handler_(std::move(handler)), listening_(listenAt(path_), "socket"),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "eventfd"), thread_([this] { serve(); }) {}

ControlSocket::~ControlSocket() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t n = write(stop_.get(), &one, sizeof one);
    thread_.join();
    unlink(path_.c_str());
}

// False at the end of the time or of this object.
bool ControlSocket::isReady(int fd, short events, int timeoutMs) const {
    std::array<pollfd, 2> waiting{{{fd, events, 0}, {stop_.get(), POLLIN, 0}}};
    const Timestamp end = Timestamp::now() + std::chrono::milliseconds(timeoutMs);
    for (int left = timeoutMs;;
         left = static_cast<int>(std::max<std::int64_t>((end - Timestamp::now()).count(), 0) /
                                 1'000'000)) {
        const int count = poll(waiting.data(), waiting.size(), left);
        if (count < 0 && errno == EINTR) continue;
        return count > 0 && waiting[1].revents == 0;
    }
}

void ControlSocket::serve() {
    constexpr int kEver = 1 << 30;
    for (;;) {
        if (!isReady(listening_.get(), POLLIN, kEver)) {
            pollfd stop{stop_.get(), POLLIN, 0};
            if (poll(&stop, 1, 0) != 0) return;
            continue;
        }
        const int client =
            accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (client < 0) continue;
        serveOne(client);
        close(client);
    }
}

void ControlSocket::serveOne(int client) {
    std::string request;
    if (!receive(client, request)) return;
    ControlAnswer answer = handler_(request);
    answer.line += '\n';
    send(client, answer.line.data(), answer.line.size());
    send(client, answer.data.data(), answer.data.size());
}

// Up to the line end, or to the end of what the client has to say. A request that is too long is
// cut off, which the handler sees at its length.
bool ControlSocket::receive(int client, std::string& request) const {
    const Timestamp end = Timestamp::now() + std::chrono::milliseconds(kRequestMs);
    std::array<char, 1024> part{};
    while (request.size() <= kLongestRequest) {
        const auto left = (end - Timestamp::now()).count() / 1'000'000;
        if (left <= 0 || !isReady(client, POLLIN, static_cast<int>(left))) return false;
        const ssize_t bytes = recv(client, part.data(), part.size(), 0);
        if (bytes < 0) return false;
        request.append(part.data(), static_cast<std::size_t>(bytes));
        const std::size_t lineEnd = request.find('\n');
        if (lineEnd != request.npos) request.resize(lineEnd);
        if (lineEnd != request.npos || bytes == 0) return !request.empty();
    }
    return true;
}

void ControlSocket::send(int client, const void* data, std::size_t bytes) const {
    const Timestamp end = Timestamp::now() + std::chrono::milliseconds(kAnswerMs);
    const auto* at = static_cast<const std::uint8_t*>(data);
    while (bytes > 0) {
        const auto left = (end - Timestamp::now()).count() / 1'000'000;
        if (left <= 0 || !isReady(client, POLLOUT, static_cast<int>(left))) return;
        const ssize_t sent = ::send(client, at, bytes, MSG_NOSIGNAL);
        if (sent < 0) return;
        at += sent;
        bytes -= static_cast<std::size_t>(sent);
    }
}

}  // namespace mfar
