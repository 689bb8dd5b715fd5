// The commands of mfarctl. Only the thread that owns data may use the data. So a command may have
// several parts that run on different threads.

#include "daemon/app.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <stdexcept>

namespace mfar {
namespace {

using nlohmann::ordered_json;

/// Longest wait of a command of mfarctl for another thread. A command may wait several times. Even
/// on the slowest board, one picture takes less time.
constexpr std::chrono::milliseconds kAnswerTime{10'000};

}  // namespace

ControlActions App::controlActions() {
    const auto here = [this](auto work) { return calls_.call(std::move(work), kAnswerTime); };
    const auto session = [this](auto work) {
        return sessionCalls_.call(std::move(work), kAnswerTime);
    };
    ControlActions actions;
    actions.status = [here] { return here([](App& app) { return app.statusNow(); }); };
    actions.stats = [here] { return here([](App& app) { return app.statsNow(); }); };
    actions.reload = [here] {
        const std::shared_future<std::string> answer = here([](App& app) { return app.reload(); });
        if (answer.wait_for(kAnswerTime) != std::future_status::ready)
            throw std::runtime_error(
                "the configuration is still being read; the log will report the result");
        return answer.get();
    };
    actions.snapshot = [session](bool screen) {
        return session([screen](Session& s) { return s.snapshot(screen); });
    };
    actions.record = [this](const std::string& name) { return startRecording(name); };
    actions.stopRecording = [this] { return stopRecording(); };
    actions.trigger = [session] { session([](Session& s) { s.askForStill(); }); };
    actions.resetLearning = [session] { session([](Session& s) { s.resetLearning(); }); };
    return actions;
}

ordered_json App::statusNow() {
    const Counted counted = stats_.count();
    const Health now = health(counted);
    const char* state = "starting";
    if (running_) state = "running";
    if (stopReason_) state = "ending";
    ordered_json out = {{"state", state}, {"health", healthJson(now)}, {"fault", nullptr}};
    if (counted.fault) out["fault"] = *counted.fault;
    if (!running_) return out;
    takeChanges(counted);
    const RunDescription& run = running_->description;
    const double elapsed = secondsBetween(running_->time, Timestamp::now());
    out.update({{"seconds", elapsed},
                {"engine", run.engine},
                {"renderer", run.renderer},
                {"source", run.source},
                {"poses", run.poses},
                {"display", run.display},
                {"mode", run.mode},
                {"frames", counted.frames},
                {"fps", counted.recentFps},
                {"cameras", cameraStatus(counted)},
                {"recording", nullptr},
                {"line", statusLine(counted, run, elapsed, now)}});
    if (!counted.recording.empty()) out["recording"] = counted.recording.string();
    if (counted.learning) out["learned"] = describe(*counted.learning);
    return out;
}

ordered_json App::statsNow() {
    const Counted counted = stats_.count();
    if (running_) takeChanges(counted);
    ordered_json out = summary(counted, running_ ? running_->description : RunDescription{}, "", 0);
    out.erase("exit_reason");
    out.erase("exit_code");
    out["health"] = healthJson(health(counted));
    return out;
}

// Runs on an answer thread of the control socket. The recording's folder is created on this thread,
// so that the picture thread does not wait for the disk.
std::filesystem::path App::startRecording(const std::string& name) {
    const auto make =
        sessionCalls_.call([name](Session& s) { return s.makeRecording(name); }, kAnswerTime);
    const std::shared_ptr<Recorder> recorder = make();
    sessionCalls_.call([recorder](Session& s) { s.startRecording(recorder); }, kAnswerTime);
    return std::filesystem::absolute(recorder->folder());
}

// Runs on an answer thread of the control socket. The recording is completed on this thread, so
// that the picture thread does not wait for the disk.
ordered_json App::stopRecording() {
    const auto finish =
        sessionCalls_.call([](Session& s) { return s.stopRecording(); }, kAnswerTime);
    finishesRecording_ = true;
    const std::shared_ptr<void> atEnd(nullptr, [this](void*) { finishesRecording_ = false; });
    const Recorded recorded = finish();
    return {{"folder", std::filesystem::absolute(recorded.folder).string()},
            {"video", recorded.video},
            {"stills", recorded.stills},
            {"dropped", recorded.dropped}};
}

}  // namespace mfar
