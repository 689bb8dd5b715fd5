#pragma once

#include "base/owned_fd.h"

namespace mfar {

/// Listens to the kernel's uevents (AF_NETLINK) for displays that are added, removed or changed. If
/// the process has no permission for such a socket, nothing is ever reported.
class DisplayEvents {
public:
    DisplayEvents();
    /// Returns whether a display was added, removed or changed since the last call. Never waits.
    [[nodiscard]] bool changed();

private:
    OwnedFd socket_;
};

}  // namespace mfar
