#include "daemon/service.h"

#include "base/time.h"

#include <fmt/format.h>

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace mfar {
namespace {

// Errors are ignored, because a failed notification must not stop the pictures.
void tell(const std::string& state) {
    (void)sd_notify(0, state.c_str());
}

// Replaces line breaks, because in sd_notify(3) each line is a separate assignment.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

Service::Service() : listening_(std::getenv("NOTIFY_SOCKET") != nullptr) {
    std::uint64_t us = 0;
    // watchdogPeriod_ is half of systemd's timeout, so that one late call does no harm.
    if (listening_ && sd_watchdog_enabled(0, &us) > 0)
        watchdogPeriod_ = std::chrono::duration<double>(static_cast<double>(us) * 1e-6 / 2);
}

void Service::ready(const std::string& status) const {
    tell(fmt::format("READY=1\nSTATUS={}", oneLine(status)));
}

void Service::status(const std::string& status) const {
    tell(fmt::format("STATUS={}", oneLine(status)));
}

void Service::reloading() const {
    tell(fmt::format("RELOADING=1\nMONOTONIC_USEC={}", Timestamp::now().ns / 1000));
}

void Service::stopping(const std::string& status) const {
    tell(fmt::format("STOPPING=1\nSTATUS={}", oneLine(status)));
}

void Service::watchdogPatience(int times) const {
    if (watchdogPeriod_)
        tell(fmt::format("WATCHDOG_USEC={:.0f}", 2e6 * times * watchdogPeriod_->count()));
}

void Service::alive() const {
    tell("WATCHDOG=1");
}

}  // namespace mfar
