#pragma once

#include "tests/measure/eval/shot.h"

#include <cstdint>
#include <map>

namespace mfar::eval {

enum class PoseSource {
    Recorded,  ///< from the recording, see posesOf()
    Tags,
    None,
};

/// Poses of one recording for the evaluated methods. The truth always uses recorded poses.
class KnownPoses {
public:
    /// `recording` must outlive this object. With PoseSource::Tags, all frames are tracked in the
    /// order of their times, with the recording's tags.toml. A still is tracked after the first
    /// frame that is not earlier than the still; its pose is found from the tags in the still.
    /// Throws TagMapError and ImageFileError.
    KnownPoses(const Recording& recording, PoseSource source);

    /// Poses at two times. `still` may also be the time of a video frame.
    [[nodiscard]] PosePair of(Timestamp frame, Timestamp still) const;

private:
    void track();

    const Recording& recording_;
    PoseSource source_;
    std::map<std::int64_t, Pose> video_, still_;
};

}  // namespace mfar::eval
