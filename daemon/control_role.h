#pragma once

#include <sys/types.h>

#include <optional>
#include <span>

namespace mfar {

/// What a client of the control socket may do.
enum class ControlRole {
    Observer,  ///< ask how mfard is
    Operator,  ///< everything
};

/// Members of this group are operators, beside root and the user that mfard runs as.
inline constexpr const char* kOperatorsGroup = "mfar-operators";

/// Its number; nothing where the system has no such group.
[[nodiscard]] std::optional<gid_t> operatorsGroup();

/// The role of a process with this user and these groups, which the kernel tells of a socket's
/// other end.
[[nodiscard]] ControlRole roleOf(uid_t user, std::span<const gid_t> groups,
                                 std::optional<gid_t> operators);

/// Of the process that connected this Unix socket. Observer where the kernel does not say.
[[nodiscard]] ControlRole roleOfPeer(int socket, std::optional<gid_t> operators);

}  // namespace mfar
