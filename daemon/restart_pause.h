#pragma once

#include "base/time.h"
#include "daemon/exit_code.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

class Log;

/// How long a service that cannot run waits before it ends, as the service manager starts it again
/// at once, for ever. The first failure ends at once, the next ones in a row wait 1, 3, 7, 15 and
/// then 30 s each. Systemd's own RestartSteps= begins with 254 and counts every restart since the
/// unit was started by hand: a crash in a month would wait as well.
class RestartPause {
public:
    /// `file` keeps the count from one process to the next; empty, or one that cannot be written:
    /// each wait is 5 s.
    explicit RestartPause(std::filesystem::path file) : file_(std::move(file)) {}
    /// In $STATE_DIRECTORY, see systemd.exec(5).
    [[nodiscard]] static std::filesystem::path defaultFile();

    struct Next {
        int inARow = 1;
        std::chrono::seconds wait{0};
    };
    /// Counts a process that was started at `started` and failed at `now`. One that had run for a
    /// minute begins a new row, and so does the first after a long time or a start of the system.
    [[nodiscard]] Next failed(Timestamp started, Timestamp now) const;

private:
    [[nodiscard]] int failuresBefore(Timestamp started) const;

    std::filesystem::path file_;
};

/// The service manager starts a process again that ended with this, see RestartPreventExitStatus=
/// in systemd/mfard.service.in.
[[nodiscard]] bool isRestarted(ExitCode code);

/// Where a service manager listens and will start mfard again: says in the log and in the status
/// what to do and when that is, and waits. SIGTERM and SIGINT, which must be blocked, end the wait.
void pauseBeforeRestart(ExitCode code, const std::string& error, Timestamp started, Log& log);

}  // namespace mfar
