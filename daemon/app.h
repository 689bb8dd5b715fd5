#pragma once

#include "daemon/call_queue.h"
#include "daemon/config.h"
#include "daemon/control.h"
#include "daemon/control_socket.h"
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
#include <fstream>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace mfar {

/// The main thread: signals, timers, status, shutdown. It waits for nothing but its events, so that
/// it can end the program even when a device or a driver hangs.
/// After a signal no more frames are taken and the trigger line is set inactive. Frames in process
/// are still shown and written. When this takes longer than
///   0.2 s, and nothing is being written: the process ends, even in the middle of a picture
///   0.4 s, otherwise: writing to slow readers of the display's pipe is given up; 0.5 s later the
///          process ends
/// A run that ends by itself waits for its output without a limit, and then at most 2.5 s for its
/// devices.
/// A second signal ends the process at once. If the main thread itself hangs during shutdown (in a
/// driver, on a disk that does not answer), LastResort ends the process 2.5 s after the signal.
class App {
public:
    /// Throws ConfigError, Failure.
    App(const Options& options, Log& log);

    /// Runs until the end and writes summary and report, even if the run fails. Throws the error
    /// that ended the run.
    [[nodiscard]] ExitCode run();

private:
    /// The GL thread's report after set-up.
    struct Ready {
        RunDescription description;
        std::string startLine;
        Timestamp time;
    };
    /// The GL thread reports this once all output is written.
    struct Over {
        std::string reason;
        std::exception_ptr error;  ///< null: no error
    };
    /// A reload of the configuration. A thread of its own does it, as reading models may take long.
    struct Reload {
        Reload() : answer(said.get_future().share()) {}

        std::promise<std::string> said;  ///< what has changed, or why the reload was refused
        std::shared_future<std::string> answer;
        std::future<Config> config;
        std::jthread reader;
    };

    [[nodiscard]] std::string runSession(const Config& config);
    void handle(const Event& event);
    void onReady();
    void onOver();
    void onSignal(int signal);
    void onDeadline();
    void stop(const std::string& reason);
    [[nodiscard]] bool writes();
    void leaveIfHanging();
    [[noreturn]] void leave(const std::string& why);
    void removeControl() const;
    [[noreturn]] void leaveFailed(const std::exception_ptr& error);
    void onHangUp();
    /// The future is ready once the configuration has been read. Throws std::runtime_error without
    /// a file.
    std::shared_future<std::string> reload();
    void readAgain();
    [[nodiscard]] bool isReading() const;
    void onRead();
    [[nodiscard]] std::string take(const Config& wanted);
    [[nodiscard]] ControlActions controlActions();
    [[nodiscard]] nlohmann::ordered_json statusNow();
    [[nodiscard]] nlohmann::ordered_json statsNow();
    void startRecording(const std::string& name);
    [[nodiscard]] nlohmann::ordered_json stopRecording();
    void onTick();
    void setTicks();
    [[nodiscard]] Health health(const Counted& counted);
    void feedWatchdog(const Health& health);
    void logHealth(const Health& health);
    void takeChanges(const Counted& counted);
    void showStatus(const Counted& counted, const Health& health);
    [[nodiscard]] ExitCode finish(std::future<std::string>& end);
    [[nodiscard]] bool writeResults(const std::string& reason, ExitCode code);
    [[nodiscard]] nlohmann::ordered_json results(const std::string& reason, int code);
    /// Throws std::runtime_error.
    void writeReport(const nlohmann::ordered_json& results);

    const Timestamp started_ = Timestamp::now();
    LastResort lastResort_;  ///< first: it watches the others' destruction, too
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
    std::atomic<bool> finishesRecording_{false};  ///< after mfarctl ended a recording
    std::stop_source input_;
    std::stop_source cancel_;
    std::jthread stopper_;  ///< stops the devices, which may take long
    std::optional<std::string> stopReason_;
    std::optional<int> stopSignal_;
    std::optional<Ready> running_;
    std::optional<Over> ended_;
    bool isProven_ = false;  ///< all shaders are compiled: time limits apply without kFirstPatience
    bool patienceEnded_ = false;  ///< the watchdog's limit no longer has kFirstPatience either
    HealthRecord health_;
    Timestamp statusShown_;
    /// `nextReload_` was requested during `reload_` and follows it: the file may have changed
    /// meanwhile.
    std::optional<Reload> reload_, nextReload_;
    Health told_;                     ///< the health that was last written to the log
    bool firstPictureShown_ = false;  ///< the log has the line about it

    std::mutex mutex_;
    // Guarded by the mutex; they move to running_ and ended_.
    std::optional<Ready> ready_;
    std::optional<Over> over_;

    std::optional<ControlSocket> control_;  ///< last: its thread uses all of the above
};

}  // namespace mfar
