#pragma once

#include "hal/virtual/recording.h"
#include "pipeline/pipeline.h"
#include "tests/measure/eval/pose_source.h"

#include <cstddef>

namespace mfar::demo {

/// Before each frame, feed() gives the pipeline the newest still that was taken before this frame.
/// No still is given twice.
class StillFeed {
public:
    /// `poses`: poses of the stills; null: none. Both arguments must outlive this object.
    explicit StillFeed(const Recording& recording, const eval::KnownPoses* poses = nullptr)
        : recording_(recording), poses_(poses) {}

    void feed(Pipeline& pipeline, Timestamp frame);

private:
    const Recording& recording_;
    const eval::KnownPoses* poses_;
    std::size_t next_ = 0;
};

}  // namespace mfar::demo
