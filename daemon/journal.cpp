#include "daemon/journal.h"

#include "base/owned_fd.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/un.h>

#include <cstring>
// The fields CODE_FILE, CODE_LINE and CODE_FUNC do not help readers of the journal.
#define SD_JOURNAL_SUPPRESS_LOCATION
#include <systemd/sd-journal.h>

namespace mfar {
namespace {

constexpr int kRoomMs = 500;

}  // namespace

// Returns true if the journal accepts a message. The socket of libsystemd would block and cannot be
// polled. So another socket is connected to the same address, and that one is polled.
bool Journal::hasRoom() const {
    const OwnedFd probe(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket_.c_str(), sizeof address.sun_path - 1);
    if (!probe ||
        connect(probe.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        return false;
    pollfd room{probe.get(), POLLOUT, 0};
    return poll(&room, 1, waits_ ? kRoomMs : 0) == 1 && (room.revents & POLLOUT) != 0;
}

bool Journal::operator()(const std::vector<std::string>& fields) {
    waits_ = hasRoom();
    if (!waits_) return false;
    std::vector<iovec> parts;
    parts.reserve(fields.size());
    for (const std::string& field : fields)
        parts.push_back({const_cast<char*>(field.data()), field.size()});
    return sd_journal_sendv(parts.data(), static_cast<int>(parts.size())) >= 0;
}

}  // namespace mfar
