#pragma once

#include "base/time.h"
#include "daemon/exit_code.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

class Log;

/// Delay before a failed service exits, because the service manager restarts it at once, without
/// limit. The first failure exits at once, the next ones in a row wait 1, 3, 7, 15 and then 30 s
/// each. Systemd's own RestartSteps= begins with 254 and counts every restart since the unit
/// was started by hand, so that one crash a month would wait as well.
class RestartPause {
public:
    /// `file` keeps the count from one process to the next. Without a file, or when it cannot be
    /// written, each wait is 5 s.
    explicit RestartPause(std::filesystem::path file) : file_(std::move(file)) {}
    /// In $STATE_DIRECTORY, see systemd.exec(5).
    [[nodiscard]] static std::filesystem::path defaultFile();

    struct Next {
        int inARow = 1;
        std::chrono::seconds wait{0};
    };
    /// Counts a process that was started at `started` and failed at `now`. The count starts again
    /// after a process that ran for a minute, after a long pause and after a boot.
    [[nodiscard]] Next failed(Timestamp started, Timestamp now) const;

private:
    [[nodiscard]] int failuresBefore(Timestamp started) const;

    std::filesystem::path file_;
};

/// True when the service manager restarts a process with this exit code, see
/// RestartPreventExitStatus= in systemd/mfard.service.in.
[[nodiscard]] bool isRestarted(ExitCode code);

/// When a service manager will restart mfard: logs a hint and the time of the restart, also as the
/// service's status, and waits. SIGTERM and SIGINT, which must be blocked, end the wait.
void pauseBeforeRestart(ExitCode code, const std::string& error, Timestamp started, Log& log);

}  // namespace mfar
