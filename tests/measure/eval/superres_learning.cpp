#include "tests/measure/eval/superres_learning.h"

#include "hal/virtual/recording.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/still_choice.h"
#include "tests/measure/eval/still_learning.h"

#include <algorithm>
#include <chrono>

namespace mfar::eval {
namespace {

struct Match {
    std::size_t frame, still;
};

/// Matches each still with a frame that does not show the still's own view: with the nearest in
/// time for rank 0, with the second-nearest for rank 1.
std::vector<Match> matchesOf(const Recording& recording, std::size_t rank) {
    std::vector<Match> out;
    for (std::size_t still = 0; still < recording.stills.size(); ++still) {
        const Timestamp time = recording.stills[still].time;
        std::vector<std::size_t> frames;
        for (std::size_t i = 0; i < recording.video.size(); ++i)
            if (!showsOwnView(recording, time, recording.video[i].time)) frames.push_back(i);
        std::ranges::stable_sort(frames, {}, [&](std::size_t i) {
            return std::chrono::abs(recording.video[i].time - time);
        });
        if (rank < frames.size()) out.push_back({frames[rank], still});
    }
    return out;
}

void learnFrom(const Recording& recording, const SuperResRequest& request, int& left,
               StillLearning& learning) {
    const KnownPoses poses(recording, request.poses);
    Pipeline pipeline(recording.rig, {.output = {}, .skipUnchanged = false});
    pipeline.setMatchListener(&learning);
    learning.begin(recording.rig);
    std::optional<Timestamp> last;
    for (std::size_t rank = 0; left != 0; ++rank) {
        const std::vector<Match> matches = matchesOf(recording, rank);
        if (matches.empty()) return;
        for (const auto& [frame, still] : matches) {
            if (left == 0) return;
            --left;
            const Timestamp at = recording.video[frame].time,
                            stillAt = recording.stills[still].time;
            const PosePair pose = poses.of(at, stillAt);
            const Shot reference{degrade(loadPicture(recording.stills[still].file),
                                         request.degradation,
                                         static_cast<std::uint64_t>(stillAt.ns)),
                                 stillAt, pose.still};
            // The noise must differ from the noise of the same frame in the measurement.
            const Shot video{degrade(loadPicture(recording.video[frame].file),
                                     request.videoDegradation,
                                     ~static_cast<std::uint64_t>(at.ns) - 1),
                             at, pose.frame};
            // Learning must not use a still that shows the last frame's own view, because such a
            // still is the frame's true picture.
            learning.setMayUseOlder(last && !showsOwnView(recording, stillAt, *last));
            last = at;
            pipeline.setFilters(learning.filters());
            PipelineShot(reference).giveAsStill(pipeline);
            PipelineShot(video).run(pipeline);
        }
        if (request.learn == kEachOnce) return;
    }
}

}  // namespace

std::shared_ptr<const FilterBank>
learnedFilters(const SuperResRequest& request,
               const std::vector<std::filesystem::path>& recordings) {
    StillLearning learning;
    int left = request.learn == kEachOnce ? 1000000 : request.learn;
    for (const std::filesystem::path& root : recordings)
        learnFrom(loadRecording(root), request, left, learning);
    learning.report();
    return learning.filters();
}

}  // namespace mfar::eval
