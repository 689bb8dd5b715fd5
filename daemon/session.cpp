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

/// The same for the same two sensors, as far as that is known.
std::string sensorsOf(const Config& config, Rig& rig) {
    const auto [video, still] = std::pair(rig.geometry().video.size, rig.geometry().still.size);
    return fmt::format("{} {} {}x{}, {} {} {}x{}", rig.video().info().name,
                       config.cameras.video.camera, video.width, video.height,
                       rig.still().info().name, config.cameras.still.camera, still.width,
                       still.height);
}

/// How often is looked for a fault while no frames come.
constexpr std::chrono::milliseconds kFaultInterval{30};

}  // namespace

// The context comes after the rig: a synthetic source has its own, and this one has to be current
// on this thread at the end.
Session::Session(const Config& config, Stats& stats, Mailbox<Tunables>& changes,
                 CallQueue<Session>& calls, StopTokens stop)
    : stats_(stats), changes_(changes), calls_(calls), stop_(std::move(stop)),
      rig_(config, stats.heartbeats()), poses_(config.pose, rig_.poseInputs(), stats),
      gl_(openGl(config)),
      validation_(config.validate ? std::make_unique<gpu::Validation>() : nullptr),
      display_(openDisplay(config, rig_.video().info().rateHz, stop_.cancel, displayPolicy())),
      output_(outputSizeFor(config.size, rig_.geometry(), display_->screenSize())),
      engines_(chooseEngines(config, gl_.context.get(), rig_.geometry(), output_)),
      pipeline_(rig_.geometry(), pipelineOptions(config)),
      virtual_(config.virtualLayer, rig_.geometry(), pipeline_),
      previews_(VirtualWorld::drawsPreviews(config.virtualLayer)), policy_(config.trigger),
      mode_(config.superres.mode), banner_(pipeline_.outputSize()),
      deadlineMs_(config.governor.governs() ? config.governor.deadlineMs : 0),
      levels_(governedLevels(config.governor)), objects_(config.objects), light_(config.light),
      tags_(poses_.tags()), sensors_(sensorsOf(config, rig_)) {
    pipeline_.setMeasure(config.status.measure);
    PlaneImporter* importer = gl_.context ? gl_.context->planeImporter() : nullptr;
    pipeline_.setImporter(importer);
    if (!gl_.without.empty())
        stats_.warn("without OpenGL ES the processor's vector units compute the pictures: " +
                    gl_.without);
    placeObjects();
    setUpQuality(config.superres.mode);
    setLearning(config.superres.learn);
    description_ = {gl_.context ? gl_.context->description() : "without OpenGL ES",
                    rig_.description(),
                    display_->name(),
                    std::string(name(config.superres.mode)),
                    rig_.videoFrames(),
                    std::nullopt,
                    poses_.description(),
                    describe(engines_),
                    rig_.video().info().rateHz};
    if (description_.source.starts_with("cameras"))
        description_.source += importer != nullptr ? ", read in place by the GPU" : ", copied";
    beginRecording(config);  // last: a failure of the others must not wait for the disk
}

Session::~Session() = default;

PipelineOptions Session::pipelineOptions(const Config& config) const {
    PipelineOptions options;
    options.mode = config.superres.mode;
    options.output = output_;
    options.skipUnchanged = config.superres.skipUnchanged;
    options.engines = engines_;
    return options;
}

void Session::setUpQuality(SuperResMode best) {
    if (levels_.empty()) return;
    std::vector<QualityLevel> levels = limitedTo(levels_, best);
    choice_ = {};
    pipeline_.setQuality(levels.front().quality);
    stats_.quality(levels.front().name, deadlineMs_);
    if (!(deadlineMs_ > 0)) return;
    governor_.emplace(std::move(levels), deadlineMs_);
    govern();
}

std::string Session::startLine() const {
    const Size out = pipeline_.outputSize();
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
        throw;
    }
}

std::string Session::showFrames(Mailbox<CapturedFrame>& mailbox, CaptureThread& capture,
                                std::optional<std::uint64_t> maxFrames) {
    Heartbeat heart(stats_.heartbeats(), std::string(kPictureThread), budget::kPicture);
    heart_ = &heart;
    const std::shared_ptr<void> atEnd(nullptr, [this](void*) { heart_ = nullptr; });
    bool enough = false;
    while (!enough) {
        heart.beat();
        const bool isGpuReady = gpu_.isReady();
        stats_.gpu(gpu_.fault());
        if (!isGpuReady) {
            if (mailbox.over()) break;
            continue;
        }
        std::optional<CapturedFrame> captured = mailbox.takeWithin(kFaultInterval);
        if (!captured && mailbox.over()) break;
        if (const std::optional<Tunables> change = changes_.tryTake()) apply(*change);
        calls_.runAll(*this);
        checkRecording();
        if (!captured) {
            showFault();
            continue;
        }
        // Without a clock of its own a source waits for us: only our own time is latency then.
        if (rig_.handOver() == HandOver::Lossless) captured->arrived = Timestamp::now();
        process(std::move(*captured));
        enough = maxFrames && pictures_ >= *maxFrames;
    }
    heart.rest();
    capture.stop();
    capture.join();
    checkRecording();
    stats_.recorderDropped(rig_.notRecorded());
    finishDisplay();
    return enough ? "all frames asked for are shown" : "end of the source";
}

void Session::finishDisplay() {
    try {
        display_->finish();
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::OutputFailed, error.what());
    }
}

// Recordings keep every picture, and who waits for that says so.
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
    mode_ = wanted.superres.mode;
    pipeline_.setMode(mode_);
    useStill();
    setUpQuality(wanted.superres.mode);
    pipeline_.setSkipUnchanged(wanted.superres.skipUnchanged);
    pipeline_.setMeasure(wanted.measure);
    setLearning(wanted.superres.learn);
    policy_.configure(wanted.trigger);
    const auto before =
        std::pair(std::exchange(objects_, wanted.objects), std::exchange(light_, wanted.light));
    try {
        placeObjects();
    } catch (const std::exception& error) {
        stats_.warn(fmt::format("objects: {}; those before stay", error.what()),
                    {message::kObjects});
        std::tie(objects_, light_) = before;
        placeObjects();
    }
}

// Previews of virtual objects are drawn with GL, whatever engine does the steps.
bool Session::canShowObjects() {
    if (gl_.context || objects_.empty() || !previews_) return true;
    if (gl_.without.empty()) {
        try {
            gl_.context = createGlContext();
            return true;
        } catch (const std::runtime_error& error) {
            gl_.without = error.what();
        }
    }
    stats_.warn("previews of virtual objects are drawn with OpenGL ES 3.1 and are not shown: " +
                    gl_.without,
                {message::kObjects});
    return false;
}

void Session::placeObjects() {
    if (!canShowObjects()) return;
    virtual_.set(objects_, light_, tags_);
    if (tags_.empty() && poses_.mayFindTags()) return;
    for (std::string& text : leftOut(objects_, tags_, virtual_.shapesAlone()))
        stats_.warn(std::move(text), {message::kObjects});
}

void Session::process(CapturedFrame captured) {
    const Timestamp begun = Timestamp::now();
    const bool newStill = captured.still.has_value();
    stats_.stillsSuperseded(captured.stillsSuperseded);
    if (captured.still) takeStill(*std::exchange(captured.still, std::nullopt));
    if (std::optional<TagMap> found = poses_.takeFoundTags()) {
        tags_ = *std::move(found);
        rig_.recordTags(tags_);
        placeObjects();
    }
    const Timestamp time = captured.video.time();
    const FrameResult& result = pipeline_.run(captured.video.view(), time, captured.pose);
    // Before the display, which may wait: the exposure runs meanwhile.
    fireIfNeeded(time, result.stats);
    previous_ = time;
    last_ = result.picture;
    const Timestamp drawn = Timestamp::now();
    show(time, result.unchanged);
    if (++pictures_ == 1) stats_.firstPicture(processUse());
    std::optional<double> age;
    if (stillTime_) age = static_cast<double>((time - *stillTime_).count()) * 1e-9;
    const Timestamp shown = Timestamp::now();
    const double ms = static_cast<double>((shown - begun).count()) * 1e-6;
    stages_ = pipeline_.stageTimes();
    stages_.push_back({"display", static_cast<double>((shown - drawn).count()) * 1e-6});
    std::optional<Timestamp> since;
    if (rig_.cameraKind() == CameraKind::Sensor) since = std::min(time, shown);
    stats_.picture({result.stats, stages_, captured.arrived, shown, age, ms, since});
    if (governor_) {
        governor_->add({ms, newStill, result.stats.usedStill, result.stats.changed});
        govern();
    }
    tell(time);
    if (validation_) tellFaultyPasses();
}

void Session::tell(Timestamp time) {
    if (const auto traced = pipeline_.tracedCounters()) stats_.traced(*traced, time);
    tellLearning();
    if (auto error = pipeline_.takeSceneError())
        stats_.warn("objects: " + *error, {message::kObjects});
    if (auto error = pipeline_.takeImportFault()) stats_.warn(*error + ": it is copied");
    stats_.recorderDropped(rig_.notRecorded());
    if (auto matching = rig_.matching()) {
        // It is the policy that repeats.
        matching->repeated = static_cast<std::uint64_t>(policy_.repetitions());
        stats_.matching(*matching);
    }
}

void Session::tellFaultyPasses() {
    for (const gpu::ValidationFault& fault : validation_->takeFaults()) {
        ++validated_.faults;
        stats_.warn("validation: " + describe(fault));
    }
    validated_.values = 0;
    for (const auto& [pass, count] : validation_->counts())
        validated_.values += static_cast<std::uint64_t>(count.values);
    stats_.validation(validated_);
    validation_->nextFrame();
}

void Session::govern() {
    if (governor_->next() == choice_) return;
    choice_ = governor_->next();
    pipeline_.setQuality(governor_->level().quality);
    if (choice_.redraw) pipeline_.redraw();
    stats_.quality(governor_->level().name, deadlineMs_);
}

void Session::takeStill(CapturedStill still) {
    policy_.stillArrived(still.frame.time());
    newestStill_ = std::move(still);
    useStill();
}

// A picture that is only enlarged needs no still; it is kept until another mode does.
void Session::useStill() {
    if (!newestStill_ || mode_ == SuperResMode::Off) return;
    const CapturedStill still = *std::exchange(newestStill_, std::nullopt);
    if (learning_) {
        learning_->finish();
        if (auto filters = learning_->takeFilters()) pipeline_.setFilters(std::move(filters));
    }
    pipeline_.setStill(still.frame.view(), still.frame.time(), still.pose);
    stillTime_ = still.frame.time();
    stats_.stillUsed();
}

ScreenPicture Session::snapshot(bool ofScreen) const {
    if (!shown_) throw std::runtime_error("there is no picture yet");
    if (!ofScreen) return copyOf(*shown_);
    std::optional<ScreenPicture> screen = display_->lastShown();
    if (!screen) throw std::runtime_error("there is no screen: " + display_->name());
    return *std::move(screen);
}

void Session::askForStill() {
    if (rig_.trigger() == nullptr) throw std::runtime_error("there is no trigger");
    policy_.ask();
}

void Session::fireIfNeeded(Timestamp frame, const FrameStats& stats) {
    Trigger* trigger = rig_.trigger();
    if (trigger == nullptr || (governor_ && !governor_->mayTakeStill())) return;
    if (policy_.decide(frame, previous_.value_or(frame), stats)) {
        try {
            trigger->fire();
        } catch (const TriggerBusy&) {
            policy_.busy();
        } catch (const std::runtime_error& error) {
            // One that is waited for says so in the picture.
            if (!rig_.fault())
                throw Failure(ExitCode::Unavailable, trigger->name() + ": " + error.what());
        }
    }
    if (policy_.lost() > lostTold_) {
        lostTold_ = policy_.lost();
        stats_.warn(fmt::format("{}: no still has come for a pulse{}", trigger->name(),
                                policy_.pending() ? ", it is asked for once more" : ""),
                    {message::kStill, "still"});
    }
    stats_.triggers(static_cast<std::uint64_t>(policy_.fired()),
                    static_cast<std::uint64_t>(policy_.lost()));
}

// Frames bring the fault with them; without them it is shown over the last picture.
void Session::showFault() {
    const std::optional<std::string> fault = rig_.fault();
    // The thread that tells it otherwise may wait for the device that is at fault.
    stats_.fault(fault);
    if (!fault) return;
    show(Timestamp::now(), true);
    stats_.bannerShown(Timestamp::now());
}

// The last picture of the pipeline, with what is wrong over it.
void Session::show(Timestamp time, bool unchanged) {
    const std::string fault = rig_.fault().value_or("");
    try {
        if (unchanged && shown_ && fault == faultShown_) {
            gpu_.drawn();
            display_->showAgain(*shown_, time);
        } else {
            shown_ = fault.empty() ? last_ : banner_.over(last_, fault);
            faultShown_ = fault;
            gpu_.drawn();
            display_->show(*shown_, time);
        }
        stats_.display(display_->name());
        stats_.displayed(display_->fault(), display_->leftOut());
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::OutputFailed, error.what());
    }
}

}  // namespace mfar
