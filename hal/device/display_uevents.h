#pragma once

#include "base/owned_fd.h"

namespace mfar {

/// Listens to uevents (AF_NETLINK) to notice that a display was added, removed or changed. If the
/// process has no permission for such a socket, no change is ever noticed.
class DisplayEvents {
public:
    DisplayEvents();
    /// Returns whether a display was added, removed or changed since the last call. Never waits.
    [[nodiscard]] bool changed();

private:
    OwnedFd socket_;
};

}  // namespace mfar
