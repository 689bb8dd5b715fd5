#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Sends messages to systemd's journal, see sd_journal_sendv(3). If the journal is full, a message
/// waits for room, at most half a second, and then fails. The messages after it do not wait: they
/// fail at once, until the journal has room again. Only one thread at a time may use it.
class Journal {
public:
    explicit Journal(std::string socket = "/run/systemd/journal/socket")
        : socket_(std::move(socket)) {}

    /// Sends a message with fields "NAME=value". Returns false if there is no journal or it is
    /// full.
    bool operator()(const std::vector<std::string>& fields);

private:
    [[nodiscard]] bool hasRoom() const;

    std::string socket_;
    bool waits_ = true;
};

}  // namespace mfar
