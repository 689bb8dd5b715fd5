#pragma once

#include "base/time.h"
#include "daemon/exit_code.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

class Log;

/// Computes how long a failed service waits before it exits. Without this pause, systemd would
/// restart it at once, again and again. The first failure causes no pause. Further consecutive
/// failures cause pauses of 1, 3, 7, 15 and then 30 s.
///
/// systemd's RestartSteps= is not used. It exists since version 254 only, and counts all restarts
/// since the unit was started, so that even one crash a month would cause a pause.
class RestartPause {
public:
    /// `file` stores the number of consecutive failures for the next process. Without a writable
    /// file, each pause is 5 s.
    explicit RestartPause(std::filesystem::path file) : file_(std::move(file)) {}
    [[nodiscard]] static std::filesystem::path defaultFile();

    struct Next {
        int inARow = 1;
        std::chrono::seconds wait{0};
    };
    /// Counts a failure of a process that ran from `started` to `now`. The count begins again after
    /// a process that ran for a minute, after a minute without a process, and after a boot.
    [[nodiscard]] Next failed(Timestamp started, Timestamp now) const;

private:
    [[nodiscard]] int failuresBefore(Timestamp started) const;

    std::filesystem::path file_;
};

/// Returns true if systemd restarts a process after this exit code, see RestartPreventExitStatus=
/// in systemd/mfard.service.in.
[[nodiscard]] bool isRestarted(ExitCode code);

/// If systemd will restart mfard, logs a hint and the time of the restart, sets the service's
/// status, and waits. SIGTERM and SIGINT end the wait; the caller must have blocked them.
void pauseBeforeRestart(ExitCode code, const std::string& error, Timestamp started, Log& log);

}  // namespace mfar
