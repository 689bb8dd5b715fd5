#pragma once

#include "tests/measure/eval/shot.h"

#include <cstdint>
#include <map>

namespace mfar::eval {

/// Who tells the methods where the camera was.
enum class PoseSource {
    Recorded,  ///< the recording, see posesOf()
    Tags,      ///< the product's tracker, from the tags in frames and stills
    None,      ///< nobody
};

/// The poses of one recording as methods get them. What is measured against stays as recorded.
class KnownPoses {
public:
    /// `recording` must outlive this. Tags: goes through all pictures in the order of their times,
    /// with the recording's tags.toml. A still has the pose that it shows itself; pictures without
    /// one have none. Throws TagMapError and ImageFileError.
    KnownPoses(const Recording& recording, PoseSource source);

    /// `still` may also be the time of a video frame.
    [[nodiscard]] PosePair of(Timestamp frame, Timestamp still) const;

private:
    void track();

    const Recording& recording_;
    PoseSource source_;
    std::map<std::int64_t, Pose> video_, still_;  // by time [ns]
};

}  // namespace mfar::eval
