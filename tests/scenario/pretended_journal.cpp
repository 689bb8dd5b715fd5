// A library for LD_PRELOAD that redirects messages for the systemd journal to the socket whose path
// is in the environment variable MFAR_PRETENDED_JOURNAL.

#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace {

class Address {
public:
    Address(const void* wanted, socklen_t bytes) : to_(wanted), bytes_(bytes) {
        const auto* local = static_cast<const sockaddr_un*>(wanted);
        const char* pretended = std::getenv("MFAR_PRETENDED_JOURNAL");
        if (wanted == nullptr || pretended == nullptr || local->sun_family != AF_UNIX ||
            std::strcmp(local->sun_path, "/run/systemd/journal/socket") != 0)
            return;
        other_.sun_family = AF_UNIX;
        std::strncpy(other_.sun_path, pretended, sizeof other_.sun_path - 1);
        to_ = &other_;
        bytes_ = sizeof other_;
    }
    Address(const Address&) = delete;
    Address& operator=(const Address&) = delete;

    [[nodiscard]] const void* get() const { return to_; }
    [[nodiscard]] socklen_t bytes() const { return bytes_; }

private:
    sockaddr_un other_{};
    const void* to_;
    socklen_t bytes_;
};

}  // namespace

extern "C" {

int connect(int fd, const sockaddr* wanted, socklen_t bytes) {
    const Address to(wanted, bytes);
    return static_cast<int>(syscall(SYS_connect, fd, to.get(), to.bytes()));
}

ssize_t sendmsg(int fd, const msghdr* message, int flags) {
    const Address to(message->msg_name, message->msg_namelen);
    msghdr sent = *message;
    sent.msg_name = const_cast<void*>(to.get());
    sent.msg_namelen = to.bytes();
    return syscall(SYS_sendmsg, fd, &sent, flags);
}

}  // extern "C"
