#pragma once

#include "tests/measure/eval/shot.h"

#include <cstdint>
#include <map>

namespace mfar::eval {

/// Source of the camera poses that methods get.
enum class PoseSource {
    Recorded,  ///< poses of the recording, see posesOf()
    Tags,      ///< the product's tracker, from the tags in frames and stills
    None,      ///< no poses
};

/// The poses of one recording as methods get them. The truth stays as recorded.
class KnownPoses {
public:
    /// `recording` must outlive this. Tags: processes all pictures in the order of their times,
    /// with the recording's tags.toml. A still has the pose computed from the still itself; a
    /// picture without a pose has none. Throws TagMapError and ImageFileError.
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
