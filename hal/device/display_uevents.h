#pragma once

#include "base/owned_fd.h"

namespace mfar {

/// Reports displays that appear, disappear or change, from the kernel's uevent socket. Without
/// permission for such a socket (AF_NETLINK) it never reports anything.
class DisplayEvents {
public:
    DisplayEvents();
    /// True when a display appeared, disappeared or changed since the last call. Never waits.
    [[nodiscard]] bool changed();

private:
    OwnedFd socket_;
};

}  // namespace mfar
