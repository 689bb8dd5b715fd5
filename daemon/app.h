#pragma once

#include "daemon/call_queue.h"
#include "daemon/config.h"
#include "daemon/control.h"
#include "daemon/control_socket.h"
#include "daemon/due_times.h"
#include "daemon/events.h"
#include "daemon/exit_code.h"
#include "daemon/health.h"
#include "daemon/last_resort.h"
#include "daemon/log.h"
#include "daemon/mailbox.h"
#include "daemon/options.h"
#include "daemon/service.h"
#include "daemon/session.h"
#include "daemon/stats.h"
#include "daemon/status.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace mfar {

/// The main thread of mfard. It handles signals, timers, status and shutdown. The main thread waits
/// for events and never for a device or a driver, so it can end the program even if one of them
/// hangs.
///
/// After SIGINT or SIGTERM, no more frames are fetched and the trigger line is set inactive. Frames
/// that are being processed are still shown and written, within these limits:
///   - If nothing is being written, the process ends at most 0.2 s after the signal, even in the
///     middle of a picture. With a report, which shows that picture, it waits up to 1.5 s for the
///     picture, and then writes the report.
///   - Otherwise, writing to slow readers of the display's pipe is cancelled 0.4 s after the
///     signal, and the process ends at most 0.5 s later.
/// A second signal ends the process at once, except the same signal within 0.1 s. If the main
/// thread itself hangs during the shutdown, LastResort logs after 2.5 s that output may be missing,
/// and ends the process.
///
/// If a run ends without a signal, mfard waits without a limit until all output is written, and
/// then at most 2.5 s for the devices. If the picture thread hangs at the end of --seconds, mfard
/// ends without waiting for that thread.
class App {
public:
    /// Throws Failure, e.g. ConfigError, and std::system_error if the kernel has no free
    /// descriptor.
    App(const Options& options, Log& log);

    /// Runs until the end. Writes the summary and the report, even if the run fails. Throws the
    /// error that ended the run.
    [[nodiscard]] ExitCode run();

private:
    /// The picture thread sends this after its set-up.
    struct Ready {
        RunDescription description;
        std::string startLine;
        Timestamp time;
    };
    /// The picture thread sends this after it has written all output, or after an error.
    struct Over {
        std::string reason;
        std::exception_ptr error;
    };
    /// A reload of the configuration. It has its own thread, because reading models may take long.
    struct Reload {
        Reload() : answer(said.get_future().share()) {}

        std::promise<std::string> said;
        std::shared_future<std::string> answer;
        std::future<Config> config;
        std::jthread reader;
    };

    [[nodiscard]] std::string runSession(const Config& config);
    void handle(const Event& event);
    void onReady();
    void onOver();
    void onSignal(int signal);
    [[noreturn]] void endUnfinished(int signal);
    void onDeadline();
    void stop(const std::string& reason);
    [[nodiscard]] bool writes();
    void leaveIfHanging();
    [[noreturn]] void leave(const std::string& why);
    void removeControl() const;
    [[noreturn]] void leaveFailed(const std::exception_ptr& error);
    void onHangUp();
    /// Starts a reload of the configuration. The returned future becomes ready when the file has
    /// been read, or when mfard ends. It then has the answer for the user, or an error: the
    /// configuration was refused, or mfard is ending. Throws std::runtime_error if mfard has no
    /// configuration file.
    std::shared_future<std::string> reload();
    void readAgain();
    [[nodiscard]] bool isReading() const;
    void onRead();
    [[nodiscard]] std::string take(const Config& wanted);
    [[nodiscard]] ControlActions controlActions();
    [[nodiscard]] nlohmann::ordered_json statusNow();
    [[nodiscard]] nlohmann::ordered_json statsNow();
    std::filesystem::path startRecording(const std::string& name);
    [[nodiscard]] nlohmann::ordered_json stopRecording();
    void onTick();
    void logNotes();
    void setTicks();
    [[nodiscard]] Health health(const Counted& counted);
    void feedWatchdog(const Health& health);
    void logHealth(const Health& health);
    void takeChanges(const Counted& counted);
    void logChanges(const Counted& counted);
    void logWarnings();
    void showStatus(const Counted& counted, const Health& health);
    [[nodiscard]] ExitCode finish(std::future<std::string>& end);
    void refuseCalls();
    void endControl();
    [[nodiscard]] bool writeResults(const std::string& reason, ExitCode code);
    [[nodiscard]] nlohmann::ordered_json results(const std::string& reason, int code);
    void writeReport(const nlohmann::ordered_json& results);

    const Timestamp started_ = Timestamp::now();
    LastResort lastResort_, unfinished_;
    const Options options_;
    Log& log_;
    Config config_;
    std::ofstream summary_;
    const Service service_;
    Events events_;
    Stats stats_;
    Mailbox<Tunables> changes_{HandOver::NewestWins};
    CallQueue<App> calls_{[this] { events_.wake(); }};
    CallQueue<Session> sessionCalls_;
    std::atomic<bool> finishesRecording_{false};
    std::stop_source input_;
    std::stop_source cancel_;
    std::jthread stopper_;  ///< stops the devices; this may take long
    std::optional<std::string> stopReason_;
    std::optional<int> stopSignal_;
    Timestamp stopSignalAt_;
    std::optional<Ready> running_;
    std::optional<Over> ended_;
    /// True after kFirstPictures pictures. All shaders have been compiled by then. While this is
    /// false, some time limits are longer, see kFirstPatience.
    bool isProven_ = false;
    bool patienceEnded_ = false;  ///< true: systemd's watchdog has its normal timeout again
    HealthRecord health_;
    DueTimes statusDue_;
    /// A reload that is requested while `reload_` runs becomes `nextReload_`. It starts after
    /// `reload_`, because the file may have changed since `reload_` read it.
    std::optional<Reload> reload_, nextReload_;
    Health told_;
    bool firstPictureShown_ = false;

    std::mutex mutex_;
    // mutex_ guards ready_ and over_. The main thread moves them to running_ and ended_.
    std::optional<Ready> ready_;
    std::optional<Over> over_;

    std::optional<ControlSocket> control_;  ///< last member: its thread uses the members above
};

}  // namespace mfar
