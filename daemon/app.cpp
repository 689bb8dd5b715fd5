#include "daemon/app.h"

#include "daemon/budgets.h"
#include "daemon/rig_inputs.h"
#include "daemon/rig_words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

namespace mfar {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kLookTime{1};
/// The normal time limits apply after this number of pictures. Before that, some time limits are
/// longer, see kFirstPatience.
constexpr std::uint64_t kFirstPictures = 10;

std::ofstream openSummary(const Options& options, const Config& config) {
    std::ofstream file;
    if (!options.summary) return file;
    if (*options.summary == "-") {
        if (config.display == "y4m:-")
            throw Failure(ExitCode::Usage,
                          "--summary - and display y4m:- both write to standard output; give one "
                          "of them a file");
        return file;
    }
    // The file is opened at the start of the run. Otherwise, a wrong path would be noticed only
    // after a long run, and the summary would be lost.
    file.open(*options.summary);
    if (!file)
        throw Failure(ExitCode::OutputFailed,
                      options.summary->string() + ": cannot be written: " + std::strerror(errno));
    return file;
}

// The message names the camera, because the log writes equal messages only once in ten seconds. If
// the second camera's message were equal to the first camera's, it could come ten seconds late.
std::string recovered(std::string_view camera) {
    return camera == "video" || camera == "still" ? fmt::format("the {} camera works again", camera)
                                                  : "all devices are available again";
}

}  // namespace

App::App(const Options& options, Log& log)
    : options_(options), log_(log), config_(effectiveConfig(options)),
      summary_(openSummary(options, config_)) {
    logNotes();
    // SIGPIPE is ignored, so that writing to a closed pipe returns an error instead of ending the
    // process.
    signal(SIGPIPE, SIG_IGN);
    if (options_.report) {
        stats_.keepHistory();
        // A first report is written at the start of the run. If the file cannot be written, this is
        // noticed before a long run.
        orFail(ExitCode::OutputFailed,
               [this] { writeReport(results("the run has not ended", 0)); });
    }
    if (options_.control)
        control_.emplace(
            *options_.control,
            [actions = controlActions()](std::string_view request, ControlRole role) {
                return answerControl(actions, request, role);
            },
            &stats_.heartbeats());
}

ExitCode App::run() {
    std::packaged_task<std::string()> session(
        [this, config = config_] { return runSession(config); });
    std::future<std::string> end = session.get_future();
    const std::jthread glThread([&] {
        session();
        events_.wake();
    });
    setTicks();
    try {
        {
            Heartbeat heart(stats_.heartbeats(), "main", budget::kMain);
            while (end.wait_for(Seconds(0)) != std::future_status::ready) {
                heart.rest();
                const Event event = events_.wait();
                heart.beat();
                handle(event);
            }
        }
        return finish(end);
    } catch (const std::exception& error) {
        // The destructor of `glThread` waits until the thread has ended, so the thread must be
        // asked to stop first.
        input_.request_stop();
        cancel_.request_stop();
        if (isReading()) {
            log_.endStatus();
            log_.error(error.what(), {message::kFailed});
            std::_Exit(static_cast<int>(exitCode(error)));
        }
        throw;
    }
}

std::string App::runSession(const Config& config) {
    // The files are checked here, not in the constructor, so that the summary and the report
    // contain the fault.
    requireFiles(config, RecordingCheck::Folder);
    Session session(config, stats_, changes_, sessionCalls_,
                    {input_.get_token(), cancel_.get_token()});
    RunDescription description = session.description();
    description.plannedPictures = options_.frames;
    description.plannedSeconds = options_.seconds;
    {
        const std::lock_guard lock(mutex_);
        ready_ = Ready{std::move(description), session.startLine(), Timestamp::now()};
    }
    events_.wake();
    return session.run(options_.frames,
                       [this](const std::string& reason, const std::exception_ptr& error) {
                           {
                               const std::lock_guard lock(mutex_);
                               over_ = Over{reason, error};
                           }
                           events_.wake();
                       });
}

void App::handle(const Event& event) {
    switch (event.kind) {
    case Event::Kind::Signal: return onSignal(event.signal);
    case Event::Kind::Deadline: return onDeadline();
    case Event::Kind::Tick: return onTick();
    case Event::Kind::Wake: break;
    }
    onReady();
    onOver();
    onRead();
    calls_.runAll(*this);
}

void App::onReady() {
    {
        const std::lock_guard lock(mutex_);
        if (!ready_) return;
        running_ = std::exchange(ready_, std::nullopt);
    }
    // A reload during the start may have changed the mode already.
    running_->description.mode = name(config_.superres.mode);
    log_.notice(running_->startLine, {message::kStarted});
    service_.ready(running_->startLine);
    service_.watchdogPatience(kFirstPatience);
    if (options_.seconds && !stopReason_) events_.deadlineIn(Seconds(*options_.seconds));
}

void App::onHangUp() {
    if (options_.config)
        (void)reload();
    else
        log_.warning(
            "SIGHUP: mfard was started without --config, so there is no file to read again");
}

std::shared_future<std::string> App::reload() {
    if (!options_.config)
        throw std::runtime_error(
            "mfard was started without --config, so there is no file to read again");
    if (reload_) {
        if (!nextReload_) nextReload_.emplace();
        return nextReload_->answer;
    }
    reload_.emplace();
    readAgain();
    return reload_->answer;
}

void App::readAgain() {
    if (running_) service_.reloading();
    std::packaged_task<Config()> read([this] { return usableConfig(options_); });
    reload_->config = read.get_future();
    reload_->reader = std::jthread([this, read = std::move(read)]() mutable {
        const Heartbeat heart(stats_.heartbeats(), "reload", budget::kReload, ThreadRole::Helper);
        read();
        events_.wake();
    });
}

bool App::isReading() const {
    return reload_ && reload_->config.wait_for(Seconds(0)) != std::future_status::ready;
}

void App::onRead() {
    if (!reload_ || isReading()) return;
    Reload done = std::move(*reload_);
    try {
        done.said.set_value(take(done.config.get()));
    } catch (const std::exception& error) {
        log_.error(fmt::format("{}\nthe old configuration stays in use", error.what()),
                   {message::kReloadRefused});
        done.said.set_exception(std::current_exception());
    }
    if (running_) service_.ready(running_->startLine);
    reload_ = std::exchange(nextReload_, std::nullopt);
    if (reload_) readAgain();
}

// Applies the settings that can change while mfard runs. Returns a message that names the changed
// settings that need a restart.
std::string App::take(const Config& wanted) {
    const std::string restart = needRestart(config_, wanted);
    config_.superres = wanted.superres;
    config_.trigger = wanted.trigger;
    config_.status = wanted.status;
    config_.objects = wanted.objects;
    config_.light = wanted.light;
    config_.notes = wanted.notes;
    logNotes();
    changes_.put(tunables(config_));
    setTicks();
    if (running_) running_->description.mode = name(config_.superres.mode);
    std::string said =
        options_.config->string() + ": read again" +
        (restart.empty() ? "" : "; these settings change only after a restart: " + restart);
    log_.notice(said, {message::kReloaded});
    return said;
}

void App::logNotes() {
    for (const std::string& note : notesOf(config_))
        log_.warning(note, {}, {message::kObjects});
}

void App::setTicks() {
    const Seconds status(config_.status.intervalS);
    const Seconds look = std::min(kLookTime, service_.watchdogPeriod().value_or(kLookTime));
    events_.tickEvery(std::min(look, status));
}

void App::onTick() {
    const Counted counted = stats_.count();
    const Health now = health(counted);
    logHealth(now);
    feedWatchdog(now);
    if (running_) logWarnings();
    log_.sayKept();
    leaveIfHanging();
    logChanges(counted);
    if (statusDue_.isDue(Timestamp::now().seconds(), config_.status.intervalS))
        showStatus(counted, now);
}

Health App::health(const Counted& counted) {
    isProven_ = isProven_ || counted.frames >= kFirstPictures;
    Observed seen{Timestamp::now()};
    seen.patience = isProven_ ? 1 : kFirstPatience;
    seen.late = stats_.heartbeats().late(seen.patience);
    seen.waiting = stats_.heartbeats().waiting();
    seen.fault = counted.fault;
    seen.gpu = counted.gpuFault;
    seen.display = counted.displayFault;
    const CameraState& video = counted.cameras[static_cast<std::size_t>(CameraRole::Video)];
    if (video.repeats) seen.repeats = video.lastDistinct;
    seen.lastPicture = counted.lastPicture;
    seen.lastExcuse = counted.lastExcuse;
    if (running_) {
        seen.started = running_->time;
        seen.rateHz = running_->description.videoRateHz;
    }
    return health_.judge(seen);
}

// During the start, systemd uses TimeoutStartSec= instead of the watchdog. During a shutdown, the
// watchdog is always fed, because TimeoutStopSec= limits the shutdown.
void App::feedWatchdog(const Health& health) {
    if (!running_ || !service_.watchdogPeriod()) return;
    if (isProven_ && !std::exchange(patienceEnded_, true)) service_.watchdogPatience(1);
    if (health.isAlive() || stopReason_) service_.alive();
}

void App::logHealth(const Health& health) {
    if (health.state == told_.state && health.cause == told_.cause) {
        told_.sinceS = health.sinceS;
        return;
    }
    // During a shutdown, no new pictures are expected, so the state Stalled is not a fault.
    if (stopReason_ && health.state == HealthState::Stalled) return;
    // One camera may be opened later than the other, so a short fault at the start is not logged.
    if (health.isDevice && !isProven_ && health.sinceS < kOpeningS) return;
    if (health.state != HealthState::Ok)
        log_.warning(sentence(health), health.cause, subjectOf(health));
    else if (told_.isDevice)
        log_.change(recovered(subjectOf(told_).camera), {}, {message::kRecovered});
    else
        log_.change(fmt::format("works again after {:.1f} s", told_.sinceS), "works again",
                    {message::kRecovered});
    told_ = health;
}

void App::logChanges(const Counted& counted) {
    if (!running_) return;
    takeChanges(counted);
    if (counted.atFirstPicture && !std::exchange(firstPictureShown_, true))
        log_.notice(firstPictureLine(*counted.atFirstPicture, counted.displayFault));
}

void App::takeChanges(const Counted& counted) {
    RunDescription& run = running_->description;
    if (counted.rendering) {
        run.engine = counted.rendering->engine;
        run.renderer = counted.rendering->renderer;
        run.source = counted.rendering->source;
    }
    if (!counted.display.empty() && counted.display != run.display) {
        run.display = counted.display;
        log_.change("display " + counted.display, {}, {message::kDisplay});
    }
}

void App::logWarnings() {
    for (const Warning& warning : stats_.takeWarnings())
        log_.warning(warning.text, {}, warning.subject);
}

void App::showStatus(const Counted& counted, const Health& health) {
    if (!running_) return;
    const double elapsed = secondsBetween(running_->time, Timestamp::now());
    logChanges(counted);
    logWarnings();
    const std::string line = statusLine(counted, running_->description, elapsed, health);
    log_.status(line);
    if (!stopReason_) service_.status(line);
}

}  // namespace mfar
