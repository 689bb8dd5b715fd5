#include "daemon/status.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace mfar {
namespace {

constexpr std::array<const char*, kTileClasses> kTileNames = {"unchanged", "enlarged", "trusted",
                                                              "blended"};

std::optional<double> progress(const Counted& counted, const RunDescription& run, double elapsedS) {
    std::optional<double> done;
    const auto add = [&](double past, auto planned) {
        if (planned && *planned > 0)
            done = std::max(done.value_or(0), past / static_cast<double>(*planned));
    };
    // Dropped frames of a recording count as done, too.
    add(static_cast<double>(counted.frames + counted.drops.mailbox + counted.drops.sensor),
        run.plannedFrames);
    add(static_cast<double>(counted.frames), run.plannedPictures);
    add(elapsedS, run.plannedSeconds);
    if (done) done = std::clamp(*done, 0.0, 1.0);
    return done;
}

std::string bar(double done) {
    constexpr int kWidth = 16;
    const int full = static_cast<int>(done * kWidth);
    return fmt::format("[{:#<{}}{:.<{}}] {:3.0f}% ", "", full, "", kWidth - full, done * 100);
}

template <class Tiles>
std::array<double, kTileClasses> shares(const Tiles& tiles) {
    double all = 0;
    for (const auto count : tiles)
        all += static_cast<double>(count);
    std::array<double, kTileClasses> out{};
    for (std::size_t i = 0; i < kTileClasses; ++i)
        out[i] = all > 0 ? static_cast<double>(tiles[i]) / all : 0;
    return out;
}

// Returns e.g. ", tracked 98% (6 tags, 0.12 px, 2.1 ms)", or an empty text if no pose was
// requested.
std::string tracking(const PoseCounts& poses) {
    if (poses.frames == 0) return "";
    std::string out = fmt::format(", tracked {:.0f}%", poses.trackedShare() * 100);
    if (poses.tracker.frames == 0) return out;
    if (poses.last && poses.last->tags > 0)
        out += fmt::format(" ({} tags, {:.2f} px", poses.last->tags, poses.last->reprojectionError);
    else
        out += poses.last ? " (no tag, predicted" : " (no tag";
    return out + fmt::format(", {:.1f} ms)", poses.tracker.lastMs);
}

// Returns e.g. ", quality lines-2 (3% late)", or an empty text if there is neither a governor nor a
// pinned level.
std::string quality(const QualityCounts& counts) {
    if (counts.level.empty()) return "";
    std::string out = ", quality " + counts.level;
    if (counts.deadlineMs > 0 && counts.frames > 0)
        out += fmt::format(" ({:.0f}% late)", 100.0 * static_cast<double>(counts.late) /
                                                  static_cast<double>(counts.frames));
    return out;
}

nlohmann::ordered_json qualitySummary(const QualityCounts& counts) {
    nlohmann::ordered_json levels = nlohmann::ordered_json::object();
    for (const auto& [level, frames] : counts.framesOf)
        levels[level] = frames;
    return {{"deadline_ms", counts.deadlineMs},
            {"late", counts.late},
            {"frame_ms",
             {{"median", counts.frameMs.quantile(0.5)},
              {"p95", counts.frameMs.quantile(0.95)},
              {"p99", counts.frameMs.quantile(0.99)}}},
            {"frames_of_level", levels}};
}

nlohmann::ordered_json quantiles(const Histogram& times) {
    return {{"median", times.quantile(0.5)}, {"p99", times.quantile(0.99)}};
}

nlohmann::ordered_json poseSummary(const Counted& counted, const std::string& from) {
    const PoseCounts& poses = counted.poses;
    return {
        {"from", from},
        {"asked", poses.frames},
        {"tracked", poses.tracked},
        {"measured", poses.measured},
        {"tracked_share", poses.trackedShare()},
        {"epipolar_frames", counted.epipolarFrames},
        {"tiles_searched_2d", counted.tilesSearched2d},
        {"depth_tiles", counted.depthTiles},
        {"depth_tiles_skipped", counted.depthTilesSkipped},
        {"keyframe_searches", counted.keyframeSearches},
        {"predicted_frames", counted.predictedFrames},
        {"refined_frames", counted.refinedFrames},
        {"epipolar_px", counted.meanEpipolarError},
        {"tags", poses.meanTags()},
        {"reprojection_px", poses.meanErrorPx()},
        {"full_searches", poses.tracker.fullSearches},
        {"roi_searches", poses.tracker.roiSearches},
        {"flips", poses.tracker.flips},
        {"rejected", poses.tracker.rejected},
        {"jumps", poses.tracker.jumps},
        {"track_ms", quantiles(poses.ms)},
        {"stills_asked", poses.stills},
        {"stills_tracked", poses.stillsTracked},
        {"stills_measured", poses.stillsMeasured},
        {"still_track_ms", quantiles(poses.stillMs)},
    };
}

nlohmann::ordered_json virtualSummary(const Counted& counted) {
    nlohmann::ordered_json out = {{"frames_in_view", counted.objectFrames},
                                  {"frames_hidden", counted.hiddenFrames}};
    if (!counted.traced) return out;
    const TracedLayerCounters& t = *counted.traced;
    out["path_tracer"] = {{"samples", t.render.samples},
                          {"samples_per_second", t.render.samplesPerSecond},
                          {"cpu_ms", t.render.cpuMs},
                          {"budget_kept", t.render.budget.mean},
                          {"budget_p95_deviation", t.render.budget.deviation},
                          {"budget_frames", t.render.budget.frames},
                          {"pictures_finished", t.render.pictures},
                          {"pictures_shown", t.render.shown},
                          {"reference_age_s", counted.referenceAgeS.value_or(0)},
                          {"frames_warped", t.warped},
                          {"frames_unmoved", t.unmoved},
                          {"holes_asked", t.requested},
                          {"holes_rendered", t.answered}};
    return out;
}

// Returns e.g. ", path tracing 83% at 1.20 M samples/s, 120 pixels missing", or an empty text if no
// path-traced object is in view.
std::string tracing(const Counted& counted) {
    if (!counted.traced || !counted.last.objectsInView) return "";
    if (counted.last.objectsHidden) return ", objects hidden";
    const TracedLayerCounters& t = *counted.traced;
    std::string out = t.render.idle
                          ? std::string(", path traced")
                          : fmt::format(", path tracing {:.0f}% at {:.2f} M samples/s",
                                        t.render.progress * 100, t.render.samplesPerSecond * 1e-6);
    if (t.openHoles > 0) out += fmt::format(", {} pixels missing", t.openHoles);
    return out;
}

nlohmann::ordered_json lineSummary(const StillCounters& line) {
    return {{"fired", line.fired},
            {"matched", line.matched},
            {"unmatched", line.unmatched},
            {"lost", line.lost},
            {"late", line.late},
            {"repeated", line.repeated},
            {"relearned", line.relearned},
            {"overtaken", line.overtaken},
            {"missed_edges", line.missedEdges}};
}

nlohmann::ordered_json cameraSummary(const CameraState& camera) {
    const CameraCounters& c = camera.counters;
    nlohmann::ordered_json out = {{"configured_hz", camera.configuredHz},
                                  {"measured_hz", camera.rateHz},
                                  {"delivered", c.delivered},
                                  {"broken", c.broken},
                                  {"bad_times", c.badTimes},
                                  {"startup", c.startup},
                                  {"untimed", c.untimed},
                                  {"restarts", c.restarts},
                                  {"reopened", c.reopened},
                                  {"repeated_pictures", camera.repeated}};
    if (c.missed) out["missed"] = *c.missed;
    if (camera.distinctAgeS) out["distinct_age_s"] = *camera.distinctAgeS;
    return out;
}

nlohmann::ordered_json tileSummary(const Counted& counted) {
    nlohmann::ordered_json out;
    const auto tileShares = shares(counted.tiles);
    for (std::size_t i = 0; i < kTileClasses; ++i)
        out[kTileNames[i]] = tileShares[i];
    return out;
}

nlohmann::ordered_json firstPictureSummary(const ProcessUse& use) {
    return {{"since_start_ms", use.ms}, {"cpu_ms", use.cpuMs}, {"resident_mb", use.residentMb}};
}

nlohmann::ordered_json learningSummary(const LearningCounts& counts) {
    return {{"stills_learned", counts.learner.stills},
            {"stills_repeated", counts.learner.repeated},
            {"stills_refused", counts.learner.refused},
            {"stills_left_out", counts.leftOut},
            {"classes", counts.learner.classes},
            {"gain_db", counts.learner.gainDb},
            {"shipped_gain_db", counts.learner.priorDb},
            {"still_pairs", counts.learner.pairs},
            {"guidance_still", counts.learner.guidance.still},
            {"guidance_video", counts.learner.guidance.video},
            {"guidance_light", counts.learner.guidance.light},
            {"guidance_gain_db", counts.learner.guidanceGainDb},
            {"fine_noise", counts.learner.fineMatch.noise},
            {"fine_share", counts.learner.fineMatch.share}};
}

nlohmann::ordered_json validationSummary(const ValidationCounts& counts) {
    return {{"values_checked", counts.values}, {"faulty_outputs", counts.faults}};
}

nlohmann::ordered_json stillSummary(const Counted& counted) {
    return {{"triggered", counted.stills.triggered},
            {"received", counted.stills.received},
            {"used", counted.stills.used},
            {"superseded", counted.stills.superseded},
            {"lost", counted.stills.lost},
            {"tiles_matched_second", counted.tilesMatchedSecond},
            {"tiles_show_second", counted.tilesShowSecond}};
}

nlohmann::ordered_json dropSummary(const Drops& drops) {
    return {{"sensor", drops.sensor},
            {"mailbox", drops.mailbox},
            {"recorder", drops.recorder},
            {"display", drops.display}};
}

}  // namespace

// The most important parts come first, because a terminal cuts off the end of the line.
std::string statusLine(const Counted& counted, const RunDescription& run, double elapsedS,
                       const Health& health) {
    std::string line;
    const auto out = std::back_inserter(line);
    if (const std::optional<double> done = progress(counted, run, elapsedS)) line = bar(*done);
    if (health.state != HealthState::Ok) line += sentence(health) + " | ";
    if (counted.frames == 0) return line + "waiting for the first picture";
    fmt::format_to(out, "{:.1f} fps", counted.recentFps);
    const Drops& drops = counted.drops;
    fmt::format_to(out, ", {} dropped", drops.mailbox + drops.sensor);
    if (drops.recorder > 0) fmt::format_to(out, ", {} not recorded", drops.recorder);
    if (drops.display > 0) fmt::format_to(out, ", {} not written", drops.display);
    line += quality(counted.quality);
    if (counted.last.usedStill) {
        fmt::format_to(out, ", confidence {:.2f}, still {:.1f} s old", counted.last.meanConfidence,
                       counted.stillAgeS.value_or(0));
    } else {
        line += ", no still";
    }
    line += tracking(counted.poses);
    if (counted.last.posePatches > 0)
        fmt::format_to(out, ", epipolar error {:.2f} px", counted.last.epipolarError);
    line += tracing(counted);
    line += " |";
    for (const StageTime& stage : counted.lastStages)
        fmt::format_to(out, " {} {:.1f}", stage.stage, stage.ms);
    line += " ms |";
    const auto tiles = shares(counted.last.tiles);
    for (std::size_t i = 0; i < kTileClasses; ++i)
        if (counted.last.tiles[i] > 0)
            fmt::format_to(out, " {} {:.0f}%", kTileNames[i], tiles[i] * 100);
    return line;
}

std::string firstPictureLine(const ProcessUse& use,
                             const std::optional<std::string>& displayFault) {
    return fmt::format("first picture {}{:.0f} ms after the start, {:.0f} MB resident{}",
                       displayFault ? "drawn " : "", use.ms, use.residentMb,
                       displayFault ? ", but not shown: " + *displayFault : "");
}

std::string endLine(std::uint64_t pictures, double seconds, double fps, const std::string& reason) {
    std::string line = fmt::format("{} picture{}", pictures, pictures == 1 ? "" : "s");
    if (pictures > 1)
        fmt::format_to(std::back_inserter(line), " in {:.2f} s, {:.1f} fps", seconds, fps);
    return line + ": " + reason;
}

nlohmann::ordered_json cameraStatus(const Counted& counted) {
    return {{"video", cameraSummary(counted.cameras[0])},
            {"still", cameraSummary(counted.cameras[1])}};
}

nlohmann::ordered_json summary(const Counted& counted, const RunDescription& run,
                               const std::string& exitReason, int exitCode) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (const auto& [stage, times] : counted.stageMs)
        stages[stage] = quantiles(times);
    return {
        {"version", MFAR_VERSION},
        {"exit_reason", exitReason},
        {"exit_code", exitCode},
        {"engine", run.engine},
        {"renderer", run.renderer},
        {"source", run.source},
        {"display", run.display},
        {"mode", run.mode},
        {"first_picture", firstPictureSummary(counted.atFirstPicture.value_or(ProcessUse{}))},
        {"frames", counted.frames},
        {"seconds", counted.seconds},
        {"fps", counted.fps},
        {"latency_ms", quantiles(counted.latencyMs)},
        {"stage_ms", stages},
        {"tile_share", tileSummary(counted)},
        {"mean_confidence", counted.meanConfidence},
        {"stills", stillSummary(counted)},
        {"quality", qualitySummary(counted.quality)},
        {"learning", learningSummary(counted.learning.value_or(LearningCounts{}))},
        {"cameras", cameraStatus(counted)},
        {"trigger_line", lineSummary(counted.matching)},
        {"pose", poseSummary(counted, run.poses)},
        {"virtual", virtualSummary(counted)},
        {"drops", dropSummary(counted.drops)},
        {"faults", counted.faults},
        {"gpu_failures", counted.gpuFailures},
        {"validation", validationSummary(counted.validation)},
    };
}

}  // namespace mfar
