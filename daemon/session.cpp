#include "daemon/session.h"

#include "daemon/budgets.h"
#include "daemon/exit_code.h"
#include "daemon/filter_learning.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace mfar {
namespace {

std::string sensorsOf(const Config& config, Rig& rig) {
    const auto [video, still] = std::pair(rig.geometry().video.size, rig.geometry().still.size);
    return fmt::format("{} {} {}x{}, {} {} {}x{}", rig.video().info().name,
                       config.cameras.video.camera, video.width, video.height,
                       rig.still().info().name, config.cameras.still.camera, still.width,
                       still.height);
}

// Longest wait for a frame. After each wait, faults, reloads and commands are handled.
constexpr std::chrono::milliseconds kFaultInterval{30};
// A lossless source delivers frames as fast as they are processed. Without this wait, the path
// tracer, whose priority is low, would get hardly any processor time.
constexpr std::chrono::milliseconds kTracerWait{100};

}  // namespace

// The GL context is created after the rig. A simulated board in the rig creates a GL context of its
// own, but the session's context must be the current one on this thread.
Session::Session(const Config& config, Stats& stats, Mailbox<Tunables>& changes,
                 CallQueue<Session>& calls, StopTokens stop)
    : stats_(stats), changes_(changes), calls_(calls), stop_(std::move(stop)), config_(config),
      rig_(config, stats.heartbeats()), poses_(config.pose, rig_.poseInputs(), stats),
      gl_(openGl(config, device_)),
      display_(openDisplay(config, rig_.video().info().rateHz, stop_.cancel, displayPolicy())),
      output_(outputSizeFor(config.size, rig_.geometry(), display_->screenSize())),
      policy_(config.trigger), levels_(governedLevels(config.governor)), tags_(poses_.tags()),
      sensors_(sensorsOf(config, rig_)) {
    if (!gl_.without.empty())
        stats_.warn("OpenGL ES is not available, so the CPU computes the pictures: " + gl_.without);
    try {
        makeDrawing();
    } catch (const std::runtime_error& error) {
        const std::optional<std::string> why = GpuWatch(gl_.context).lossBehind(error);
        if (!why) throw;
        makeDrawingAnew(*why);
    }
    setUpQuality(config.superres.mode);
    setLearning(config.superres.learn);
    const Rendering how = rendering();
    description_ = {how.renderer,
                    how.source,
                    display_->name(),
                    std::string(name(config.superres.mode)),
                    rig_.videoFrames(),
                    std::nullopt,
                    poses_.description(),
                    how.engine,
                    rig_.video().info().rateHz};
    beginRecording(config);
}

Session::~Session() = default;

void Session::setUpQuality(SuperResMode best) {
    if (levels_.empty()) return;
    std::vector<QualityLevel> levels = limitedTo(levels_, best);
    choice_ = {};
    setQuality(levels.front());
    if (!(deadlineMs() > 0)) return;
    governor_.emplace(std::move(levels), deadlineMs());
    govern();
}

void Session::setQuality(const QualityLevel& level) {
    quality_ = level.quality;
    drawing_->pipeline.setQuality(level.quality);
    stats_.quality(level.name, deadlineMs());
}

std::string Session::startLine() const {
    const Size out = drawing_->pipeline.outputSize();
    return fmt::format("engine {}; {}; {}; {}; display {}, {}x{}{}", description_.engine,
                       description_.renderer, description_.source, description_.poses,
                       description_.display, out.width, out.height,
                       TracedLayer::isAvailable() ? "" : "; this build has no path tracer");
}

std::string Session::run(std::optional<std::uint64_t> maxFrames, const Over& over) {
    Mailbox<CapturedFrame> mailbox(rig_.handOver());
    CaptureThread capture(rig_, poses_, stats_, mailbox);
    const std::stop_callback onStop(stop_.input, [&] { capture.stop(); });
    try {
        std::string reason = showFrames(mailbox, capture, maxFrames);
        over(reason, nullptr);
        endLearning();
        return reason;
    } catch (...) {
        over("", std::current_exception());
        endLearning();
        throw;
    }
}

std::string Session::showFrames(Mailbox<CapturedFrame>& mailbox, CaptureThread& capture,
                                std::optional<std::uint64_t> maxFrames) {
    Heartbeat heart(stats_.heartbeats(), std::string(kPictureThread), budget::kPicture);
    heart_ = &heart;
    const std::shared_ptr<void> atEnd(nullptr, [this](void*) { heart_ = nullptr; });
    std::optional<CapturedFrame> captured;
    bool enough = false;
    while (!enough) {
        heart.beat();
        try {
            const bool may = mayDraw();
            if (may && !captured) captured = mailbox.takeWithin(kFaultInterval);
            if ((!may || !captured) && mailbox.over()) break;
            if (may) showNext(captured);
            enough = maxFrames && pictures_ >= *maxFrames;
        } catch (const std::exception& error) {
            const std::optional<std::string> why = drawing_->gpu.lossBehind(error);
            if (!why) throw;
            makeDrawingAnew(*why);
        }
    }
    heart.rest();
    capture.stop();
    capture.join();
    checkRecording();
    stats_.recorderDropped(rig_.notRecorded());
    if (auto warning = drawing_->tracing.atEnd())
        stats_.warn(*std::move(warning), {message::kObjects});
    leavePictures();
    finishDisplay();
    return enough ? "the requested number of pictures has been made" : "end of the source";
}

bool Session::mayDraw() {
    const bool isReady = drawing_->gpu.isReady();
    stats_.gpu(gpuFault());
    return isReady;
}

void Session::showNext(std::optional<CapturedFrame>& captured) {
    if (std::optional<Tunables> next = changes_.tryTake()) change_ = std::move(next);
    if (change_) apply(*change_);
    change_.reset();
    calls_.runAll(*this);
    checkRecording();
    if (!captured) return showFault();
    // A frame of a lossless source waits until this thread takes it. So its latency counts from
    // now, not from its arrival.
    if (rig_.handOver() == HandOver::Lossless) captured->arrived = Timestamp::now();
    process(*captured);
    captured.reset();
    if (rig_.handOver() == HandOver::Lossless) drawing_->pipeline.waitForTracer(kTracerWait);
}

void Session::finishDisplay() {
    orFail(ExitCode::OutputFailed, [&] { display_->finish(); });
}

// With a lossless source, every picture is written. If the picture thread waits for a slow writer,
// it reports this wait, so that it does not count as hanging.
FileDisplayPolicy Session::displayPolicy() {
    FileDisplayPolicy policy;
    policy.isLive = rig_.handOver() == HandOver::NewestWins;
    policy.stalled = budget::kTaken;
    policy.writer = {&stats_.heartbeats(), "display writer", budget::kWriter, ThreadRole::Helper};
    policy.waiting = [this](const char* what) {
        if (heart_ == nullptr) return;
        if (what != nullptr)
            heart_->restFor(what);
        else
            heart_->beat();
    };
    return policy;
}

void Session::apply(const Tunables& wanted) {
    const bool isOtherMode = wanted.superres.mode != config_.superres.mode;
    config_.superres = wanted.superres;
    config_.trigger = wanted.trigger;
    config_.status.measure = wanted.measure;
    if (isOtherMode) {  // else, the governor keeps what it has measured
        drawing_->pipeline.setMode(wanted.superres.mode);
        setUpQuality(wanted.superres.mode);
        useStill();
    }
    drawing_->pipeline.setSkipUnchanged(wanted.superres.skipUnchanged);
    drawing_->pipeline.setMeasure(wanted.measure);
    setLearning(wanted.superres.learn);
    policy_.configure(wanted.trigger);
    // Placing objects anew discards estimated light, shadow catcher and path-traced pictures.
    if (wanted.objects == config_.objects && wanted.light == config_.light) return;
    const auto before = std::pair(std::exchange(config_.objects, wanted.objects),
                                  std::exchange(config_.light, wanted.light));
    try {
        placeObjects();
    } catch (const std::exception& error) {
        drawing_->gpu.requireSound();
        stats_.warn(fmt::format("objects: {}; the previous objects stay", error.what()),
                    {message::kObjects});
        std::tie(config_.objects, config_.light) = before;
        placeObjects();
    }
}

double Session::deadlineMs() const {
    return config_.governor.governs() ? config_.governor.deadlineMs : 0;
}

// Previews of virtual objects are drawn with GL, even if all steps run on SIMD.
bool Session::canShowObjects() {
    if (gl_.context || config_.objects.empty() ||
        !VirtualWorld::drawsPreviews(config_.virtualLayer))
        return true;
    if (gl_.without.empty()) {
        try {
            gl_.context = createGlContext(device_);
            return true;
        } catch (const std::runtime_error& error) {
            gl_.without = error.what();
        }
    }
    stats_.warn("previews of virtual objects need OpenGL ES 3.1 and are not shown: " + gl_.without,
                {message::kObjects});
    return false;
}

void Session::placeObjects() {
    if (!canShowObjects()) return;
    drawing_->objects.set(config_.objects, config_.light, tags_);
    if (tags_.empty() && poses_.mayFindTags()) return;
    for (std::string& text : leftOut(config_.objects, tags_, drawing_->objects.shapesAlone()))
        stats_.warn(std::move(text), {message::kObjects});
}

void Session::process(CapturedFrame& captured) {
    const Timestamp begun = Timestamp::now();
    const bool newStill = captured.still.has_value();
    stats_.stillsSuperseded(std::exchange(captured.stillsSuperseded, 0));
    if (captured.still) takeStill(*std::exchange(captured.still, std::nullopt));
    if (std::optional<TagMap> found = poses_.takeFoundTags()) {
        tags_ = *std::move(found);
        rig_.recordTags(tags_);
        placeObjects();
    }
    const Timestamp time = captured.video.time();
    const FrameResult& result = drawing_->pipeline.run(captured.video.view(), time, captured.pose);
    drawing_->gpu.requireSound();
    // The trigger fires before show(), so that the still is exposed while show() waits for the
    // screen.
    fireIfNeeded(time, result.stats);
    previous_ = time;
    drawing_->last = result.picture;
    const Timestamp drawn = Timestamp::now();
    show(time, result.unchanged);
    if (++pictures_ == 1) stats_.firstPicture(processUse());
    std::optional<double> age;
    if (stillTime_) age = secondsBetween(*stillTime_, time);
    const Timestamp shown = Timestamp::now();
    const double ms = static_cast<double>((shown - begun).count()) * 1e-6;
    stages_ = drawing_->pipeline.stageTimes();
    stages_.push_back({"display", static_cast<double>((shown - drawn).count()) * 1e-6});
    std::optional<Timestamp> since;
    if (rig_.cameraKind() == CameraKind::Sensor) since = std::min(time, shown);
    stats_.picture({result.stats, stages_, captured.arrived, shown, age, ms, since});
    if (governor_) {
        governor_->add({ms, newStill, result.stats.usedStill, result.stats.redrawn});
        govern();
    }
    tell(time, result.stats);
    if (drawing_->validation) tellFaultyPasses();
}

void Session::govern() {
    if (governor_->next() == choice_) return;
    choice_ = governor_->next();
    setQuality(governor_->level());
    if (choice_.redraw) drawing_->pipeline.redraw();
}

void Session::takeStill(CapturedStill still) {
    policy_.stillArrived(still.frame.time());
    newestStill_ = std::move(still);
    useStill();
}

void Session::useStill() {
    if (!newestStill_ || config_.superres.mode == SuperResMode::Off) return;
    const CapturedStill still = *std::exchange(newestStill_, std::nullopt);
    if (learning_) {
        // With a lossless source, this waits until all has been learned from the last still.
        if (heart_ != nullptr) heart_->rest();
        while (!learning_->finish(kFaultInterval))
            stats_.excused(Timestamp::now());
        if (heart_ != nullptr) heart_->beat();
        takeFilters();
    }
    keepUsedStill(still);
    stillTime_ = still.frame.time();
    stats_.stillUsed();
    // If the GPU is lost here, this still is set again later, from its copy.
    drawing_->pipeline.setStill(still.frame.view(), still.frame.time(), still.pose);
    keepSecondStill();
}

ScreenPicture Session::snapshot(bool ofScreen) const {
    if (!drawing_->shown) throw std::runtime_error("there is no picture yet");
    if (!ofScreen) return copyOf(*drawing_->shown);
    std::optional<ScreenPicture> screen = display_->lastShown();
    if (!screen) throw std::runtime_error("there is no screen; display: " + display_->name());
    return *std::move(screen);
}

void Session::askForStill() {
    if (rig_.trigger() == nullptr)
        throw std::runtime_error("stills cannot be requested: the source has no trigger line");
    policy_.ask();
}

bool Session::mayDemandStill() const {
    const SuperResMode mode = quality_ ? quality_->mode : config_.superres.mode;
    return mode != SuperResMode::Off && (!governor_ || governor_->mayTakeStill());
}

void Session::fireIfNeeded(Timestamp frame, const FrameStats& stats) {
    Trigger* trigger = rig_.trigger();
    if (trigger == nullptr) return;
    if (trigger->isStillComing()) policy_.stillIsComing(frame);
    if (policy_.decide(frame, previous_.value_or(frame), stats, mayDemandStill())) {
        try {
            trigger->fire();
        } catch (const TriggerBusy&) {
            policy_.busy();
        } catch (const std::runtime_error& error) {
            // If the rig already reports a fault, e.g. a missing trigger line, the session goes on,
            // and a banner shows that fault.
            if (!rig_.fault())
                throw Failure(ExitCode::Unavailable, trigger->name() + ": " + error.what());
            policy_.failed();
        }
    }
    const auto timedOut = static_cast<std::uint64_t>(policy_.timedOut());
    for (const std::string_view report :
         triggerReports_.newSince({timedOut, trigger->missedEdges(), policy_.pending()}))
        stats_.warn(fmt::format("{}: {}", trigger->name(), report), {message::kStill, "still"});
    stats_.triggers(static_cast<std::uint64_t>(policy_.fired()), timedOut, policy_.pendingSince());
}

// Called when no frame arrives. If a device has a fault, shows the last picture again, with a
// banner about that fault.
void Session::showFault() {
    if (rig_.video().isEarly()) stats_.excused(Timestamp::now());
    const std::optional<std::string> fault = rig_.fault();
    // The capture thread may be waiting for the faulty device, and then it cannot report the fault.
    stats_.fault(fault);
    if (!fault) return;
    // Between two frames of a slow camera, the same picture is not shown once more.
    const double rateHz = rig_.video().info().rateHz;
    const double periods = rateHz > 0 ? 1.5 / rateHz : 0;
    if (shownAt_ && bannerText() == drawing_->faultShown &&
        secondsBetween(*shownAt_, Timestamp::now()) < periods)
        return;
    show(Timestamp::now(), true);
    stats_.excused(Timestamp::now());
}

void Session::show(Timestamp time, bool unchanged) {
    const std::string fault = bannerText();
    shownAt_ = Timestamp::now();
    try {
        if (unchanged && drawing_->shown && fault == drawing_->faultShown) {
            drawing_->gpu.drawn();
            display_->showAgain(*drawing_->shown, time);
        } else {
            drawing_->shown =
                fault.empty() ? drawing_->last : drawing_->banner.over(drawing_->last, fault);
            drawing_->faultShown = fault;
            drawing_->gpu.drawn();
            display_->show(*drawing_->shown, time);
        }
        stats_.display(display_->name());
        stats_.displayed(display_->fault(), display_->leftOut());
    } catch (const gpu::GlError&) {
        throw;
    } catch (const GpuLost&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::OutputFailed, error.what());
    }
}

}  // namespace mfar
