#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Sends messages to the journal of systemd, see sd_journal_sendv(3). When the journal is full, the
/// first message waits for half a second; further ones do not wait until there is room again. Used
/// by one thread at a time.
class Journal {
public:
    /// `socket`: the journal's address.
    explicit Journal(std::string socket = "/run/systemd/journal/socket")
        : socket_(std::move(socket)) {}

    /// `fields`: "NAME=value". False when there is no journal or it is full.
    bool operator()(const std::vector<std::string>& fields);

private:
    [[nodiscard]] bool hasRoom() const;

    std::string socket_;
    bool waits_ = true;
};

}  // namespace mfar
