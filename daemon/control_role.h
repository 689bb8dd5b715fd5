#pragma once

#include <sys/types.h>

#include <optional>
#include <span>

namespace mfar {

/// Which requests a client of the control socket may make.
enum class ControlRole {
    Observer,  ///< status and stats only
    Operator,  ///< all requests
};

/// Members of this group are operators, and so are root and the user that mfard runs as.
inline constexpr const char* kOperatorsGroup = "mfar-operators";

/// The group's number; nothing where the system has no such group.
[[nodiscard]] std::optional<gid_t> operatorsGroup();

/// The role of a process with this user and these groups, which the kernel reports for the peer of
/// a socket.
[[nodiscard]] ControlRole roleOf(uid_t user, std::span<const gid_t> groups,
                                 std::optional<gid_t> operators);

/// The role of the process that connected this Unix socket; Observer where the kernel does not
/// report it.
[[nodiscard]] ControlRole roleOfPeer(int socket, std::optional<gid_t> operators);

}  // namespace mfar
