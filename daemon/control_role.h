#pragma once

#include <sys/types.h>

#include <optional>
#include <span>

namespace mfar {

enum class ControlRole {
    Observer,  ///< status and stats only
    Operator,  ///< all requests
};

/// Members of this group are operators, and so are root and the user that mfard runs as.
inline constexpr const char* kOperatorsGroup = "mfar-operators";

[[nodiscard]] std::optional<gid_t> operatorsGroup();

[[nodiscard]] ControlRole roleOf(uid_t user, std::span<const gid_t> groups,
                                 std::optional<gid_t> operators);

/// Returns the role of the process at the other end of a Unix socket. Returns Observer if the
/// kernel does not report that process.
[[nodiscard]] ControlRole roleOfPeer(int socket, std::optional<gid_t> operators);

}  // namespace mfar
