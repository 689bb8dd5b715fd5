#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace mfar {

/// Notifies systemd of start, status, reload and end, and feeds systemd's watchdog; see
/// sd_notify(3). Does nothing if mfard was not started by a service manager ($NOTIFY_SOCKET is not
/// set).
class Service {
public:
    Service();

    [[nodiscard]] bool listening() const { return listening_; }
    /// Returns the longest allowed time between calls of alive(), or nothing without a watchdog.
    [[nodiscard]] std::optional<std::chrono::duration<double>> watchdogPeriod() const {
        return watchdogPeriod_;
    }

    void ready(const std::string& status) const;
    void status(const std::string& status) const;
    /// Reports that the configuration is being read again. ready() reports that this is done.
    void reloading() const;
    void stopping(const std::string& status) const;
    void alive() const;
    /// Sets the timeout of systemd's watchdog to `times` times its value at the start.
    void watchdogPatience(int times) const;

private:
    bool listening_;
    std::optional<std::chrono::duration<double>> watchdogPeriod_;
};

}  // namespace mfar
