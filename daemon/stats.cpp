#include "daemon/stats.h"

#include "daemon/health.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr std::chrono::seconds kRateWindow{1};

double milliseconds(std::chrono::nanoseconds d) {
    return static_cast<double>(d.count()) * 1e-6;
}

double rate(std::uint64_t intervals, Timestamp from, Timestamp to) {
    const double s = secondsBetween(from, to);
    return s > 0 ? static_cast<double>(intervals) / s : 0;
}

/// Adds the counters of the earlier path tracers to those of the present one.
TracedLayerCounters sumOf(const TracedLayerCounters& before, TracedLayerCounters now) {
    now.render.samples += before.render.samples;
    now.render.cpuMs += before.render.cpuMs;
    now.render.pictures += before.render.pictures;
    now.render.shown += before.render.shown;
    now.render.holePixels += before.render.holePixels;
    now.warped += before.warped;
    now.unmoved += before.unmoved;
    now.requested += before.requested;
    now.answered += before.answered;
    return now;
}

}  // namespace

void PictureRate::add(Timestamp shown) {
    times_[count_++ % kMost] = shown;
}

double PictureRate::at(Timestamp now) const {
    if (count_ < 2) return 0;
    const auto shown = [&](std::size_t back) { return times_[(count_ - 1 - back) % kMost]; };
    const std::size_t known = std::min(count_, kMost);
    std::size_t intervals = 1;
    while (intervals + 1 < known && shown(0) - shown(intervals + 1) <= kRateWindow)
        ++intervals;
    const double fps = rate(intervals, shown(intervals), shown(0));
    const double since = secondsBetween(shown(0), now);
    return fps * since > 1 ? 1 / since : fps;
}

void Stats::picture(const FinishedPicture& picture) {
    const std::lock_guard lock(mutex_);
    ++counted_.frames;
    if (!firstShown_) firstShown_ = picture.shown;
    lastShown_ = picture.shown;
    counted_.lastPicture = picture.since.value_or(picture.shown);
    rate_.add(picture.shown);
    counted_.latencyMs.add(milliseconds(picture.shown - picture.arrived));
    for (const StageTime& stage : picture.stages) {
        auto known = std::find_if(counted_.stageMs.begin(), counted_.stageMs.end(),
                                  [&](const auto& one) { return one.first == stage.stage; });
        if (known == counted_.stageMs.end())
            known = counted_.stageMs.insert(known, {stage.stage, Histogram{}});
        known->second.add(stage.ms);
    }
    for (std::size_t i = 0; i < kTileClasses; ++i)
        counted_.tiles[i] += static_cast<std::uint64_t>(std::max(picture.stats.tiles[i], 0));
    counted_.tilesMatchedSecond +=
        static_cast<std::uint64_t>(std::max(picture.stats.matchedSecond, 0));
    counted_.tilesShowSecond += static_cast<std::uint64_t>(std::max(picture.stats.showSecond, 0));
    if (picture.stats.usedStill) {
        confidenceSum_ += picture.stats.meanConfidence;
        ++confidenceFrames_;
    }
    objects(picture.stats);
    if (picture.stats.usedPose) ++counted_.epipolarFrames;
    counted_.tilesSearched2d += static_cast<std::uint64_t>(std::max(picture.stats.searched2d, 0));
    if (picture.stats.predicted) ++counted_.predictedFrames;
    if (picture.stats.refinedPose) ++counted_.refinedFrames;
    if (picture.stats.posePatches > 0) {
        epipolarErrorSum_ += picture.stats.epipolarError;
        ++epipolarErrorFrames_;
    }
    if (!counted_.quality.level.empty()) counted_.quality.add(picture.ms);
    counted_.last = picture.stats;
    counted_.lastStages = picture.stages;
    counted_.stillAgeS = picture.stillAgeS;
    if (history_) remember(picture);
}

void Stats::remember(const FinishedPicture& picture) {
    const Drops& drops = counted_.drops;
    const StillCounts& stills = counted_.stills;
    const PoseCounts& poses = counted_.poses;
    RunMoment moment{picture.shown, picture.ms, milliseconds(picture.shown - picture.arrived)};
    moment.isLate = counted_.quality.isLate(picture.ms);
    if (picture.stats.usedStill) moment.confidence = picture.stats.meanConfidence;
    moment.totals = {drops.sensor + drops.mailbox,
                     drops.recorder,
                     drops.display,
                     stills.received,
                     stills.used,
                     stills.lost,
                     poses.frames,
                     poses.tracked,
                     counted_.learning ? counted_.learning->learner.gainDb : 0};
    history_->add(moment, picture.stages);
}

void Stats::firstPicture(const ProcessUse& use) {
    const std::lock_guard lock(mutex_);
    counted_.atFirstPicture = use;
}

void Stats::objects(const FrameStats& frame) {
    counted_.depthTiles += static_cast<std::uint64_t>(std::max(frame.depthTiles, 0));
    if (frame.objectsInView) ++counted_.objectFrames;
    if (frame.objectsHidden) ++counted_.hiddenFrames;
    counted_.depthTilesSkipped += static_cast<std::uint64_t>(std::max(frame.depthTilesSkipped, 0));
    const DepthSource depth = frame.depth;
    if (depth == DepthSource::Keyframe || depth == DepthSource::Both) ++counted_.keyframeSearches;
}

void Stats::fault(const std::optional<std::string>& fault) {
    const std::lock_guard lock(mutex_);
    const Timestamp now = Timestamp::now();
    if (!fault) fault_ = {};
    if (fault && !fault_.since) fault_.since = now;
    // Before the first picture, a camera that is being opened is a fault only if opening it takes
    // long.
    if (fault && !fault_.isCounted &&
        (counted_.frames > 0 || secondsBetween(*fault_.since, now) >= kOpeningS)) {
        ++counted_.faults;
        fault_.isCounted = true;
    }
    counted_.fault = fault;
}

void Stats::warn(std::string text, Subject subject) {
    const std::lock_guard lock(mutex_);
    warnings_.push_back({std::move(text), std::move(subject)});
}

std::vector<Warning> Stats::takeWarnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
}

void Stats::validation(const ValidationCounts& counts) {
    const std::lock_guard lock(mutex_);
    counted_.validation = counts;
}

void Stats::learning(const std::optional<LearningCounts>& counts) {
    const std::lock_guard lock(mutex_);
    counted_.learning = counts;
}

void Stats::display(const std::string& name) {
    const std::lock_guard lock(mutex_);
    if (counted_.display != name) counted_.display = name;
}

void Stats::displayed(const std::optional<std::string>& fault, std::uint64_t leftOut) {
    const std::lock_guard lock(mutex_);
    counted_.displayFault = fault;
    counted_.drops.display = leftOut;
}

void Stats::gpu(const std::optional<std::string>& fault) {
    const std::lock_guard lock(mutex_);
    counted_.gpuFault = fault;
}

void Stats::gpuFailed(const std::optional<std::string>& fault) {
    gpu(fault);
    const std::lock_guard lock(mutex_);
    ++counted_.gpuFailures;
}

void Stats::rendering(const Rendering& changed) {
    const std::lock_guard lock(mutex_);
    counted_.rendering = changed;
}

void Stats::excused(Timestamp now) {
    const std::lock_guard lock(mutex_);
    counted_.lastExcuse = now;
}

void Stats::traced(const TracedLayerCounters& counters, Timestamp frame) {
    const std::lock_guard lock(mutex_);
    // A new path tracer counts from 0 again.
    if (counters.render.cpuMs < traced_.render.cpuMs) tracedBefore_ = *counted_.traced;
    traced_ = counters;
    counted_.traced = sumOf(tracedBefore_, counters);
    counted_.referenceAgeS.reset();
    if (const auto since = counters.render.shownSince)
        counted_.referenceAgeS = secondsBetween(*since, frame);
}

void Stats::camera(CameraRole role, const CameraState& state) {
    const std::lock_guard lock(mutex_);
    counted_.cameras[static_cast<std::size_t>(role)] = state;
    if (role == CameraRole::Video) counted_.drops.sensor = state.counters.missed.value_or(0);
}

void Stats::stillReceived(Timestamp exposed) {
    const std::lock_guard lock(mutex_);
    ++counted_.stills.received;
    newestStill_ = std::max(newestStill_.value_or(exposed), exposed);
    countLost();
}

void Stats::stillUsed() {
    const std::lock_guard lock(mutex_);
    ++counted_.stills.used;
}

void Stats::stillsSuperseded(std::uint64_t stills) {
    const std::lock_guard lock(mutex_);
    counted_.stills.superseded += stills;
}

void Stats::framePose(const std::optional<Pose>& pose, const std::optional<TrackStats>& tracker) {
    const std::lock_guard lock(mutex_);
    counted_.poses.addFrame(pose, tracker);
}

void Stats::stillPose(const std::optional<Pose>& pose, const std::optional<double>& ms) {
    const std::lock_guard lock(mutex_);
    counted_.poses.addStill(pose, ms);
}

void Stats::quality(const std::string& level, double deadlineMs) {
    const std::lock_guard lock(mutex_);
    counted_.quality.level = level;
    counted_.quality.deadlineMs = deadlineMs;
}

void Stats::triggers(std::uint64_t fired, std::uint64_t timedOut,
                     std::optional<Timestamp> pendingSince) {
    const std::lock_guard lock(mutex_);
    counted_.stills.triggered = fired;
    timedOut_ = timedOut;
    pendingSince_ = pendingSince;
    countLost();
}

// A still that arrived after its timeout, or was superseded, is not lost. As every still of a
// triggered camera belongs to one pulse, the numbers tell how many pulses have no still. The policy
// awaits a still until a frame has it, and the still is received earlier than that.
void Stats::countLost() {
    StillCounts& stills = counted_.stills;
    const bool isAwaited = pendingSince_ && !(newestStill_ && *newestStill_ >= *pendingSince_);
    const std::uint64_t answered = stills.received + (isAwaited ? 1 : 0);
    stills.lost = std::min(timedOut_, stills.triggered - std::min(answered, stills.triggered));
}

void Stats::matching(const StillCounters& counters) {
    const std::lock_guard lock(mutex_);
    counted_.matching = counters;
}

void Stats::mailboxDropped(std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    counted_.drops.mailbox = total;
}

void Stats::recording(const std::filesystem::path& folder, const std::optional<std::string>& lost) {
    const std::lock_guard lock(mutex_);
    if (counted_.recording != folder) counted_.recording = folder;
    if (lost) counted_.lostRecording = lost;
}

void Stats::recorderDropped(std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    counted_.drops.recorder = total;
}

Counted Stats::count(Timestamp now) {
    const std::lock_guard lock(mutex_);
    total(now);
    return counted_;
}

void Stats::keepHistory() {
    const std::lock_guard lock(mutex_);
    if (!history_) history_.emplace();
}

bool Stats::keepsHistory() {
    const std::lock_guard lock(mutex_);
    return history_.has_value();
}

RunHistory Stats::history() {
    const std::lock_guard lock(mutex_);
    return history_.value_or(RunHistory{});
}

void Stats::pictures(RunPictures pictures) {
    const std::lock_guard lock(mutex_);
    pictures_ = std::move(pictures);
}

RunPictures Stats::pictures() {
    const std::lock_guard lock(mutex_);
    return pictures_;
}

void Stats::age(Timestamp now) {
    constexpr double kSilentS = 1, kSilentPeriods = 5;
    for (CameraState& camera : counted_.cameras) {
        if (camera.lastFrame && camera.rateHz > 0 &&
            secondsBetween(*camera.lastFrame, now) >
                std::max(kSilentS, kSilentPeriods / camera.rateHz))
            camera.rateHz = 0;
        if (camera.lastDistinct) camera.distinctAgeS = secondsBetween(*camera.lastDistinct, now);
    }
}

void Stats::total(Timestamp now) {
    age(now);
    counted_.recentFps = rate_.at(now);
    if (firstShown_) {
        counted_.seconds = secondsBetween(*firstShown_, lastShown_);
        counted_.fps = rate(counted_.frames - 1, *firstShown_, lastShown_);
    }
    if (confidenceFrames_ > 0)
        counted_.meanConfidence = confidenceSum_ / static_cast<double>(confidenceFrames_);
    if (epipolarErrorFrames_ > 0)
        counted_.meanEpipolarError = epipolarErrorSum_ / static_cast<double>(epipolarErrorFrames_);
}

}  // namespace mfar
