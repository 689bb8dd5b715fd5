#include "daemon/control_role.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <grp.h>
#include <vector>

namespace mfar {
namespace {

std::vector<gid_t> groupsOfPeer(int socket) {
    constexpr std::size_t kMost = 65536;
    std::vector<gid_t> groups(32);
    for (;;) {
        auto bytes = static_cast<socklen_t>(groups.size() * sizeof(gid_t));
        if (getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &bytes) == 0) {
            groups.resize(bytes / sizeof(gid_t));
            return groups;
        }
        if (errno != ERANGE || bytes > kMost * sizeof(gid_t) ||
            bytes <= groups.size() * sizeof(gid_t))
            return {};
        groups.resize(bytes / sizeof(gid_t));
    }
}

}  // namespace

std::optional<gid_t> operatorsGroup() {
    group entry{};
    group* found = nullptr;
    std::vector<char> text(4096);
    int error = ERANGE;
    for (; error == ERANGE && text.size() < (1U << 20U); text.resize(2 * text.size()))
        error = getgrnam_r(kOperatorsGroup, &entry, text.data(), text.size(), &found);
    if (error != 0 || found == nullptr) return std::nullopt;
    return found->gr_gid;
}

ControlRole roleOf(uid_t user, std::span<const gid_t> groups, std::optional<gid_t> operators) {
    const bool isMember = operators && std::ranges::find(groups, *operators) != groups.end();
    return user == 0 || user == geteuid() || isMember ? ControlRole::Operator
                                                      : ControlRole::Observer;
}

ControlRole roleOfPeer(int socket, std::optional<gid_t> operators) {
    ucred who{};
    socklen_t bytes = sizeof who;
    if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &who, &bytes) != 0 || bytes != sizeof who)
        return ControlRole::Observer;
    std::vector<gid_t> groups = groupsOfPeer(socket);
    groups.push_back(who.gid);
    return roleOf(who.uid, groups, operators);
}

}  // namespace mfar
