#include "base/thread_priority.h"
#include "base/whole_file.h"
#include "daemon/app.h"
#include "daemon/budgets.h"
#include "daemon/report.h"
#include "daemon/restart_pause.h"
#include "daemon/rig.h"
#include "daemon/rig_words.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <signal.h>
#include <system_error>

#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

using Seconds = std::chrono::duration<double>;

// Time limits after a signal. If no pictures are being written, the process ends at most kLeaveTime
// after the signal. If a report must show the current picture, kReportTime replaces kLeaveTime. It
// is a second shorter than kLastResort, because a slow board may need that second to write the
// report. Otherwise, writing is cancelled kFlushTime after the signal, and the process ends at most
// kCancelTime later.
constexpr Seconds kLeaveTime{0.2};
constexpr Seconds kReportTime{1.5};
constexpr Seconds kFlushTime{0.4};
// `timeout` of coreutils sends its signal to the process and then to the process group, so that it
// arrives twice.
constexpr std::chrono::milliseconds kSameSignal{100};
constexpr Seconds kCancelTime{0.5};
constexpr std::chrono::milliseconds kLastResort{2500};
constexpr std::chrono::milliseconds kLogTime{200};

[[noreturn]] void endProcess(int status) {
    raiseThreadPriorities();
    std::_Exit(status);
}

const char* signalName(int signal) {
    return signal == SIGINT ? "SIGINT" : "SIGTERM";
}

}  // namespace

void App::onSignal(int signal) {
    if (signal == SIGHUP) return onHangUp();
    if (stopSignal_ == signal && Timestamp::now() - stopSignalAt_ < kSameSignal) return;
    if (stopSignal_) {
        log_.endStatus();
        log_.warning(fmt::format("{} received after {}; ended at once", signalName(signal),
                                 signalName(*stopSignal_)),
                     {}, {message::kEnded});
        endProcess(128 + signal);
    }
    stopSignal_ = signal;
    stopSignalAt_ = Timestamp::now();
    // No message is logged in this thread: even if the log itself hangs, the signal must end the
    // process.
    lastResort_.arm(kLastResort + kLogTime, [] { endProcess(static_cast<int>(ExitCode::Ok)); });
    unfinished_.arm(kLastResort, [this, signal] { endUnfinished(signal); });
    stop(signalName(signal));
    events_.deadlineIn(writes() ? kFlushTime : options_.report ? kReportTime : kLeaveTime);
}

void App::endUnfinished(int signal) {
    log_.warning(fmt::format("shutdown after {} took longer than {} s; ended without waiting. The "
                             "last pictures, the summary or the report may be missing",
                             signalName(signal), Seconds(kLastResort).count()),
                 {}, {message::kEnded});
    const bool isLost = stats_.count().lostRecording.has_value();
    endProcess(static_cast<int>(isLost ? ExitCode::OutputFailed : ExitCode::Ok));
}

void App::onDeadline() {
    if (!stopSignal_ && ended_)
        leave("a device or output did not stop in time; ended without waiting for it");
    if (!stopSignal_) return stop("--seconds");
    if (!writes()) leave("ended before the current picture was complete");
    if (cancel_.request_stop()) return events_.deadlineIn(kCancelTime);
    leave("a device or display did not stop in time; ended without waiting for it");
}

void App::onOver() {
    {
        const std::lock_guard lock(mutex_);
        if (!over_) return;
        ended_ = std::exchange(over_, std::nullopt);
    }
    if (!stopSignal_) events_.deadlineIn(kLastResort);
}

// Ends the process if --seconds is ending the run and the picture thread hangs, e.g. in a driver of
// the GPU. A picture thread that waits for a slow output does not count as hanging. After a signal,
// onDeadline() ends the process.
void App::leaveIfHanging() {
    if (!stopReason_ || stopSignal_ || ended_) return;
    for (const Heartbeats::Late& late : stats_.heartbeats().late(isProven_ ? 1 : kFirstPatience))
        if (late.thread == kPictureThread)
            leave("the picture thread hangs; ended without waiting for it");
}

bool App::writes() {
    return finishesRecording_ || !stats_.count().recording.empty() ||
           keepsPictures(config_.display);
}

void App::leave(const std::string& why) {
    log_.endStatus();
    logWarnings();
    log_.warning(why, {}, {message::kEnded});
    if (ended_ && ended_->error) leaveFailed(ended_->error);
    const std::string reason = stopReason_.value_or(ended_ ? ended_->reason : "");
    // Without a signal, and before the picture thread has written all output, pictures may be
    // missing in the output. After a signal, missing pictures are not a failure. A recording that
    // ended before the signal is one.
    const std::optional<std::string> lost = stats_.count().lostRecording;
    if (lost) log_.error(*lost);
    const bool isComplete = !lost && (stopSignal_ || ended_ || !writes());
    const ExitCode end = isComplete ? ExitCode::Ok : ExitCode::OutputFailed;
    const bool written = writeResults(reason, end);
    removeControl();
    const ExitCode code = written || stopSignal_ ? end : ExitCode::OutputFailed;
    endProcess(static_cast<int>(code));
}

// The control socket's file must be removed here, because ControlSocket's destructor does not run.
void App::removeControl() const {
    std::error_code ignored;
    if (options_.control) std::filesystem::remove(*options_.control, ignored);
}

// Reports the failure and ends the process. Normally, main() does this, but run() cannot return to
// main() while a thread hangs.
void App::leaveFailed(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& failure) {
        const ExitCode code = exitCode(failure);
        (void)writeResults(fmt::format("error: {}", failure.what()), code);
        log_.error(failure.what(), {message::kFailed});
        removeControl();
        if (!stopSignal_) pauseBeforeRestart(code, failure.what(), started_, log_);
        endProcess(static_cast<int>(code));
    }
}

void App::stop(const std::string& reason) {
    if (!stopReason_) service_.stopping("ending: " + reason);
    stopReason_ = stopReason_.value_or(reason);
    if (!stopper_.joinable()) stopper_ = std::jthread([this] { input_.request_stop(); });
}

// Ends all waiting calls of the control socket, except those that wait for a disk.
void App::refuseCalls() {
    calls_.close();
    sessionCalls_.close();
    for (std::optional<Reload>* one : {&reload_, &nextReload_})
        if (*one)
            (*one)->said.set_exception(
                std::make_exception_ptr(std::runtime_error("mfard is ending")));
}

ExitCode App::finish(std::future<std::string>& end) {
    refuseCalls();
    // The results are written first, because the end of the control socket may wait for a disk.
    const std::shared_ptr<void> atEnd(nullptr, [this](void*) { endControl(); });
    onReady();
    const Counted counted = stats_.count();
    const Health last = health(counted);
    logHealth(last);
    showStatus(counted, last);
    log_.endStatus();
    logWarnings();
    try {
        const std::string reason = end.get();
        const ExitCode code = writeResults(stopReason_.value_or(reason), ExitCode::Ok)
                                  ? ExitCode::Ok
                                  : ExitCode::OutputFailed;
        // A thread that reads a configuration cannot be interrupted. So the process ends without
        // waiting for that thread.
        if (isReading()) {
            endControl();
            endProcess(static_cast<int>(code));
        }
        return code;
    } catch (const std::exception& error) {
        // If the reader of the display's pipe is too slow, mfard cancels the writing, or the reader
        // had stopped reading before the signal. Then missing output is no failure of mfard.
        const bool isLost = dynamic_cast<const RecordingLost*>(&error) != nullptr;
        if (!isLost && (cancel_.stop_requested() || (stopSignal_ && counted.displayFault))) {
            log_.warning(fmt::format("not all output was written: {}", error.what()), {},
                         {message::kEnded});
            (void)writeResults(*stopReason_, ExitCode::Ok);
            return ExitCode::Ok;
        }
        (void)writeResults(fmt::format("error: {}", error.what()), exitCode(error));
        if (!stopSignal_) throw;
        // The error is logged and not thrown, because main() pauses after a thrown error to delay
        // systemd's restart. After a signal, the process must end without that pause.
        log_.error(error.what());
        return exitCode(error);
    }
}

// Waits for answers that wait for a disk. If the disk hangs, a signal must end the process.
void App::endControl() {
    const SignalsEndProcess untilAnswered;
    control_.reset();
}

bool App::writeResults(const std::string& reason, ExitCode code) {
    const nlohmann::ordered_json all = results(reason, static_cast<int>(code));
    // systemd writes the end of a service to the journal itself.
    if (code == ExitCode::Ok && log_.style() != Log::Style::Journal)
        log_.notice(endLine(all["frames"].get<std::uint64_t>(), all["seconds"].get<double>(),
                            all["fps"].get<double>(), reason));
    bool isWritten = true;
    if (options_.report) {
        try {
            writeReport(all);
        } catch (const std::runtime_error& error) {
            log_.error(error.what());
            isWritten = false;
        }
    }
    if (!options_.summary) return isWritten;
    std::ostream& out = summary_.is_open() ? summary_ : std::cout;
    errno = 0;
    out << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n" << std::flush;
    if (!out)
        log_.error(fmt::format("the summary cannot be written: {}: {}", options_.summary->string(),
                               std::generic_category().message(errno != 0 ? errno : EIO)));
    return out && isWritten;
}

nlohmann::ordered_json App::results(const std::string& reason, int code) {
    const RunDescription description = running_ ? running_->description : RunDescription{};
    return summary(stats_.count(), description, reason, code);
}

// Does not wait for the disk, because there is little time after a signal.
void App::writeReport(const nlohmann::ordered_json& results) {
    const std::string written =
        fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)));
    const std::string page =
        reportPage(results, stats_.history(), stats_.pictures(), "written " + written);
    try {
        writeWholeFile(*options_.report, page, Durability::WithSync);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("the report cannot be written: {}", error.what()));
    }
}

}  // namespace mfar
