#pragma once

#include "base/time.h"
#include "daemon/exit_code.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

class Log;

/// Computes how long a service that has failed pauses before it exits. The pause is needed because
/// systemd restarts the service at once and without a limit. After the first failure there is no
/// pause; after further consecutive failures it is 1, 3, 7, 15 and then 30 s. systemd's
/// RestartSteps= is not used: it exists since version 254 only, and it counts all restarts since
/// the unit was started, so that even one crash a month would cause a pause.
class RestartPause {
public:
    /// `file` stores the number of consecutive failures for the next process. If `file` is empty or
    /// cannot be written, each pause is 5 s.
    explicit RestartPause(std::filesystem::path file) : file_(std::move(file)) {}
    /// Returns the path of the file in $STATE_DIRECTORY, see systemd.exec(5).
    [[nodiscard]] static std::filesystem::path defaultFile();

    struct Next {
        int inARow = 1;
        std::chrono::seconds wait{0};
    };
    /// Counts a failure of a process that started at `started` and failed at `now`. The count
    /// begins again after a process that ran for a minute, after a long time without a process, and
    /// after a boot.
    [[nodiscard]] Next failed(Timestamp started, Timestamp now) const;

private:
    [[nodiscard]] int failuresBefore(Timestamp started) const;

    std::filesystem::path file_;
};

/// Returns whether the service manager restarts a process that ended with this exit code, see
/// RestartPreventExitStatus= in systemd/mfard.service.in.
[[nodiscard]] bool isRestarted(ExitCode code);

/// If systemd will restart mfard, logs a hint and the time of the restart, sets the service's
/// status, and waits. SIGTERM and SIGINT, which must be blocked, end the wait.
void pauseBeforeRestart(ExitCode code, const std::string& error, Timestamp started, Log& log);

}  // namespace mfar
