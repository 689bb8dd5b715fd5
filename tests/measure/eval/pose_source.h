#pragma once

#include "tests/measure/eval/shot.h"

#include <cstdint>
#include <map>

namespace mfar::eval {

/// Source of the poses that are given to the evaluated methods.
enum class PoseSource {
    Recorded,  ///< poses of the recording, see posesOf()
    Tags,      ///< poses that the product's tracker finds from the tags in frames and stills
    None,      ///< methods get no poses
};

/// The poses of one recording, for the evaluated methods. The truth always uses the recorded poses.
class KnownPoses {
public:
    /// `recording` must outlive this object. With Tags, all pictures are processed in the order of
    /// their times, with the recording's tags.toml. The pose of a still is computed from the still
    /// itself. Throws TagMapError and ImageFileError.
    KnownPoses(const Recording& recording, PoseSource source);

    /// Poses at these two times. `still` may also be the time of a video frame.
    [[nodiscard]] PosePair of(Timestamp frame, Timestamp still) const;

private:
    void track();

    const Recording& recording_;
    PoseSource source_;
    std::map<std::int64_t, Pose> video_, still_;  // keyed by time [ns]
};

}  // namespace mfar::eval
