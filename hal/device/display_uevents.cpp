#include "hal/device/display_uevents.h"

#include <linux/netlink.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <string_view>

namespace mfar {
namespace {

// Multicast groups of uevents. The kernel's group reports a new device at once. udev's group
// reports the device when the permissions of its file in /dev are set.
constexpr unsigned kKernelGroup = 1, kUdevGroup = 2;

bool concernsDisplays(std::string_view message) {
    constexpr std::string_view kDrm{"\0SUBSYSTEM=drm\0", 15};
    constexpr std::string_view kFb{"\0SUBSYSTEM=graphics\0", 20};
    return message.find(kDrm) != message.npos || message.find(kFb) != message.npos;
}

}  // namespace

DisplayEvents::DisplayEvents()
    : socket_(
          ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_KOBJECT_UEVENT)) {
    sockaddr_nl address{};
    address.nl_family = AF_NETLINK;
    address.nl_groups = kKernelGroup | kUdevGroup;
    if (socket_ && bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        socket_ = OwnedFd();
}

bool DisplayEvents::changed() {
    bool any = false;
    std::array<char, 8192> message{};
    while (socket_) {
        const ssize_t bytes = recv(socket_.get(), message.data(), message.size(), 0);
        // A lost message may have been about a display.
        const bool lost = bytes < 0 && errno == ENOBUFS;
        if (bytes <= 0 && !lost) break;
        if (lost || concernsDisplays({message.data(), static_cast<std::size_t>(bytes)})) any = true;
    }
    return any;
}

}  // namespace mfar
