#include "daemon/restart_pause.h"

#include "base/bounded_file.h"
#include "daemon/log.h"
#include "daemon/service.h"

#include <fmt/format.h>

#include <signal.h>
#include <system_error>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace mfar {
namespace {

constexpr std::chrono::seconds kLongestWait{30};
constexpr std::chrono::seconds kWaitWithoutCount{5};
constexpr std::chrono::seconds kRan{60};
// If a process starts within this time after the end of a failed one, their failures count as
// consecutive. The time includes RestartSec= and delays of a busy system.
constexpr std::chrono::seconds kInARow{60};
constexpr int kMostCounted = 1000;
constexpr std::size_t kMostBytes = 64;

std::string textOf(const std::filesystem::path& file) {
    try {
        return boundedText(file, kMostBytes);
    } catch (const std::runtime_error&) {
        return {};
    }
}

std::string_view hint(ExitCode code) {
    if (code == ExitCode::Unavailable)
        return "a device or OpenGL ES is not available; if this does not change, choose another "
               "device in the configuration, or engine.use = \"simd\", which needs no OpenGL ES. "
               "An unplugged camera is not the cause, because mfard waits for it";
    if (code == ExitCode::OutputFailed)
        return "check `display` and [record] in the configuration, the free disk space, and the "
               "program that reads the pipe";
    return "this is a fault of mfard itself: please report it together with the lines above";
}

}  // namespace

std::filesystem::path RestartPause::defaultFile() {
    const char* folder = std::getenv("STATE_DIRECTORY");
    return folder != nullptr && *folder == '/' ? std::filesystem::path(folder) / "restarts"
                                               : std::filesystem::path();
}

// Returns the number of consecutive failures before this process. The file contains this number and
// the end time of the last failed process, on the clock that starts at boot.
int RestartPause::failuresBefore(Timestamp started) const {
    std::istringstream in(textOf(file_));
    int count = 0;
    Timestamp ended;
    if (!(in >> count >> ended.ns) || count < 0 || count > kMostCounted) return 0;
    const bool isRecent = ended <= started && started - ended <= kInARow;
    return isRecent ? count : 0;
}

RestartPause::Next RestartPause::failed(Timestamp started, Timestamp now) const {
    Next next;
    if (now - started < kRan) next.inARow = failuresBefore(started) + 1;
    const int doublings = std::min(next.inARow - 1, 5);
    next.wait = std::min(std::chrono::seconds((1 << doublings) - 1), kLongestWait);
    std::ofstream out(file_);
    out << std::min(next.inARow, kMostCounted) << ' ' << (now + next.wait).ns << '\n';
    out.flush();
    if (!out) next = {1, kWaitWithoutCount};
    return next;
}

bool isRestarted(ExitCode code) {
    return code == ExitCode::Unavailable || code == ExitCode::Internal ||
           code == ExitCode::OutputFailed;
}

void pauseBeforeRestart(ExitCode code, const std::string& error, Timestamp started, Log& log) {
    const Service service;
    if (!service.listening() || !isRestarted(code)) return;
    const RestartPause::Next next =
        RestartPause(RestartPause::defaultFile()).failed(started, Timestamp::now());
    log.notice(
        fmt::format("{}\nmfard failed {}; it exits in {} s, then systemd restarts it", hint(code),
                    next.inARow == 1 ? "once" : fmt::format("{} times in a row", next.inARow),
                    next.wait.count()));
    service.status(fmt::format("{}; restart in {} s", error, next.wait.count()));
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGINT);
    const timespec second{1, 0};
    for (std::chrono::seconds left = next.wait; left.count() > 0; left -= std::chrono::seconds(1)) {
        // systemd's watchdog must be fed during this pause.
        service.alive();
        if (sigtimedwait(&ends, nullptr, &second) > 0) return;
    }
}

}  // namespace mfar
