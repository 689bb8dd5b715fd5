#include "daemon/tools/control_client.h"

#include "base/owned_fd.h"

#include <fmt/format.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <grp.h>
#include <string>

namespace mfar {
namespace {

using nlohmann::ordered_json;

// Longest waits for an answer [s]. A recording begins and ends when the disk is ready, and a disk
// with much unwritten data may need minutes.
constexpr int kPatience = 15, kPatienceWithDisk = 600;
constexpr std::size_t kLongestLine = 1U << 20U;
constexpr std::uint64_t kMostData = 1ULL << 31U;

/// Returns a message that says who may use the socket: members of the socket's group or, if this
/// user may not enter the socket's folder, of the folder's group. If root has started mfard by
/// hand, that is root's own group, which no other user should join.
std::string noPermission(const std::filesystem::path& socket) {
    struct stat info{};
    const bool isKnown =
        stat(socket.c_str(), &info) == 0 || stat(socket.parent_path().c_str(), &info) == 0;
    if (isKnown && info.st_gid == 0) return "no permission, run mfarctl as root, e.g. with sudo";
    const group* found = isKnown ? getgrgid(info.st_gid) : nullptr;
    const std::string name = isKnown ? std::to_string(info.st_gid) : "mfar";
    return "no permission, the user must be root or in group " +
           (found != nullptr ? found->gr_name : name);
}

class Connection {
public:
    Connection(const std::filesystem::path& socket, int patience)
        : path_(socket), patience_(patience),
          fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (path_.native().size() >= sizeof address.sun_path)
            fail("the path of the socket is too long; use a shorter --socket");
        path_.native().copy(address.sun_path, path_.native().size());
        const timeval limit{patience_, 0};
        setsockopt(fd_.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        setsockopt(fd_.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
        if (connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            fail(reason());
    }

    void send(const std::string& text) const {
        const ssize_t sent = ::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL);
        if (sent < 0) fail(std::strerror(errno));
        if (static_cast<std::size_t>(sent) != text.size()) fail("mfard does not read the request");
    }
    std::string line() {
        for (;;) {
            const std::size_t end = read_.find('\n');
            if (end != read_.npos) {
                std::string out = read_.substr(0, end);
                read_.erase(0, end + 1);
                return out;
            }
            if (read_.size() > kLongestLine) fail("a line of the answer is too long");
            more();
        }
    }
    std::vector<std::uint8_t> bytes(std::uint64_t count) {
        if (count > kMostData) fail("the answer is too long");
        while (read_.size() < count)
            more();
        return {read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(count)};
    }

private:
    void more() {
        std::array<char, 65536> part{};
        const ssize_t got = recv(fd_.get(), part.data(), part.size(), 0);
        if (got < 0)
            fail(errno == EAGAIN ? "no answer within " + std::to_string(patience_) + " s"
                                 : std::strerror(errno));
        if (got == 0) fail("mfard closed the connection before its answer was complete");
        read_.append(part.data(), static_cast<std::size_t>(got));
    }
    [[nodiscard]] std::string reason() const {
        if (errno == ENOENT || errno == ECONNREFUSED) return "no mfard listens there";
        if (errno == EACCES) return noPermission(path_);
        return std::strerror(errno);
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw NotReachable(path_.string() + ": " + why);
    }

    std::filesystem::path path_;
    int patience_;
    OwnedFd fd_;
    std::string read_;
};

}  // namespace

Reply ask(const std::filesystem::path& socket, const nlohmann::json& request) {
    const bool waitsForDisk = request.value("command", "") == "record";
    Connection connection(socket, waitsForDisk ? kPatienceWithDisk : kPatience);
    // mfard refuses a name that is not UTF-8.
    constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
    connection.send(request.dump(-1, ' ', false, kReplace) + "\n");
    Reply reply{ordered_json::parse(connection.line(), nullptr, false), {}};
    if (!reply.body.is_object() || !reply.body.contains("ok") || !reply.body["ok"].is_boolean())
        throw NotReachable(socket.string() + ": the process that listens there is not mfard");
    if (!reply.body["ok"].get<bool>()) throw Refused(reply.body.value("error", "refused"));
    reply.body.erase("ok");
    if (const auto bytes = reply.body.find("bytes");
        bytes != reply.body.end() && bytes->is_number_unsigned())
        reply.data = connection.bytes(bytes->get<std::uint64_t>());
    return reply;
}

}  // namespace mfar
