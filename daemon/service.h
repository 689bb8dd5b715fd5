#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace mfar {

/// What systemd is told, see sd_notify(3): that the pictures begin, what they are doing, and that
/// they go on. Says nothing where no service manager listens ($NOTIFY_SOCKET).
class Service {
public:
    Service();

    /// A manager listens.
    [[nodiscard]] bool listening() const { return listening_; }
    /// How often alive() is to be called at least; nothing where no watchdog waits for it.
    [[nodiscard]] std::optional<std::chrono::duration<double>> watchdogPeriod() const {
        return watchdogPeriod_;
    }

    void ready(const std::string& status) const;
    void status(const std::string& status) const;
    /// The configuration is being read again; ready() ends it.
    void reloading() const;
    void stopping(const std::string& status) const;
    void alive() const;
    /// From now on the watchdog waits so many times as long as it was told to at the start of the
    /// process.
    void watchdogPatience(int times) const;

private:
    bool listening_;
    std::optional<std::chrono::duration<double>> watchdogPeriod_;
};

}  // namespace mfar
