#include "daemon/pose_counts.h"

namespace mfar {
namespace {

double ratio(double part, std::uint64_t all) {
    return all > 0 ? part / static_cast<double>(all) : 0;
}

}  // namespace

void PoseCounts::addFrame(const std::optional<Pose>& pose, const std::optional<TrackStats>& stats) {
    ++frames;
    last = pose;
    if (pose) ++tracked;
    if (pose && pose->tags > 0) {
        ++measured;
        tagSum += pose->tags;
        errorSum += pose->reprojectionError;
    }
    if (!stats) return;
    tracker = *stats;
    ms.add(stats->lastMs);
}

void PoseCounts::addStill(const std::optional<Pose>& pose, const std::optional<double>& tookMs) {
    ++stills;
    if (pose) ++stillsTracked;
    if (pose && pose->tags > 0) ++stillsMeasured;
    if (tookMs) stillMs.add(*tookMs);
}

double PoseCounts::trackedShare() const {
    return ratio(static_cast<double>(tracked), frames);
}

double PoseCounts::meanTags() const {
    return ratio(tagSum, measured);
}

double PoseCounts::meanErrorPx() const {
    return ratio(errorSum, measured);
}

}  // namespace mfar
