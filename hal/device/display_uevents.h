#pragma once

#include "base/owned_fd.h"

namespace mfar {

/// Listens to uevents (AF_NETLINK) about displays. If the process has no permission for such a
/// socket, changed() always returns false.
class DisplayEvents {
public:
    DisplayEvents();
    [[nodiscard]] bool changed();

private:
    OwnedFd socket_;
};

}  // namespace mfar
