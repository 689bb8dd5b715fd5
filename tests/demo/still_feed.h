#pragma once

#include "hal/virtual/recording.h"
#include "pipeline/pipeline.h"
#include "tests/measure/eval/pose_source.h"

#include <cstddef>

namespace mfar::demo {

/// Gives the pipeline the newest still that was taken before the frame; each still once.
class StillFeed {
public:
    /// `poses`: poses of the stills; null: the pipeline gets no poses. Both arguments must outlive
    /// this object.
    explicit StillFeed(const Recording& recording, const eval::KnownPoses* poses = nullptr)
        : recording_(recording), poses_(poses) {}

    void feed(Pipeline& pipeline, Timestamp frame);

private:
    const Recording& recording_;
    const eval::KnownPoses* poses_;
    std::size_t next_ = 0;  ///< index of the first still that was not taken before the last frame
};

}  // namespace mfar::demo
