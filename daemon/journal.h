#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Sends messages to the journal of systemd, see sd_journal_sendv(3). One that finds no room is
/// waited for half a second, those after it are not until there is room again. Used by one thread
/// at a time.
class Journal {
public:
    /// `socket`: where the journal listens.
    explicit Journal(std::string socket = "/run/systemd/journal/socket")
        : socket_(std::move(socket)) {}

    /// `fields`: "NAME=value". False when there is no journal or it takes nothing.
    bool operator()(const std::vector<std::string>& fields);

private:
    [[nodiscard]] bool hasRoom() const;

    std::string socket_;
    bool waits_ = true;
};

}  // namespace mfar
