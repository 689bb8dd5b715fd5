#pragma once

#include "base/owned_fd.h"

namespace mfar {

/// The kernel's messages about displays that come, go or change, from the uevent socket itself.
/// Without the right to such a socket (AF_NETLINK) there are none.
class DisplayEvents {
public:
    DisplayEvents();
    /// True when a display has come, gone or changed since the last call. Never waits.
    [[nodiscard]] bool changed();

private:
    OwnedFd socket_;
};

}  // namespace mfar
