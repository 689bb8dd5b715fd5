#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace mfar {

/// Notifications to systemd, see sd_notify(3): start, status, reload, end and watchdog. Does
/// nothing without a service manager ($NOTIFY_SOCKET).
class Service {
public:
    Service();

    /// True when a service manager listens.
    [[nodiscard]] bool listening() const { return listening_; }
    /// Longest time between calls of alive(); nothing without a watchdog.
    [[nodiscard]] std::optional<std::chrono::duration<double>> watchdogPeriod() const {
        return watchdogPeriod_;
    }

    void ready(const std::string& status) const;
    void status(const std::string& status) const;
    /// The configuration is being read again; ready() ends this state.
    void reloading() const;
    void stopping(const std::string& status) const;
    void alive() const;
    /// From now on the watchdog's timeout is `times` the timeout at the start of the process.
    void watchdogPatience(int times) const;

private:
    bool listening_;
    std::optional<std::chrono::duration<double>> watchdogPeriod_;
};

}  // namespace mfar
