#pragma once

#include <sys/types.h>

#include <optional>
#include <span>

namespace mfar {

/// The role of a client of the control socket. It decides which requests the client may send.
enum class ControlRole {
    Observer,  ///< status and stats only
    Operator,  ///< all requests
};

/// Members of this group are operators, and so are root and the user that mfard runs as.
inline constexpr const char* kOperatorsGroup = "mfar-operators";

/// Returns the id of the group kOperatorsGroup, or nothing if the system does not have this group.
[[nodiscard]] std::optional<gid_t> operatorsGroup();

/// Returns the role of a process with this user and these groups.
[[nodiscard]] ControlRole roleOf(uid_t user, std::span<const gid_t> groups,
                                 std::optional<gid_t> operators);

/// Returns the role of the process at the other end of a Unix socket. If the kernel does not report
/// the process, the role is Observer.
[[nodiscard]] ControlRole roleOfPeer(int socket, std::optional<gid_t> operators);

}  // namespace mfar
