#pragma once

#include "base/geometry.h"
#include "pipeline/track/tag_family.h"
#include "pipeline/track/tracker.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace mfar {

class TomlReader;

/// Who says where the camera is.
enum class PoseOrigin {
    Tags,      ///< AprilTags in video and stills
    Recorded,  ///< the recording's poses
    None,      ///< nobody: every frame is matched in both dimensions
};

/// Section [pose] of the configuration.
struct PoseConfig {
    PoseOrigin source = PoseOrigin::Tags;
    /// Tag map. Empty: the source's own; where that has none, the largest tag of the first picture
    /// with one becomes the world, and `families` and `tagSize` say what is sought.
    std::filesystem::path tags;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;         ///< [m]
    double decimation = 2;        ///< of the video: 1, 1.5 or a whole number up to 8
    int threads = 1;              ///< of the detector, per sensor
    int fullSearchInterval = 15;  ///< frames
    int bridgeFrames = 12;        ///< frames without a tag until there is no pose

    bool operator==(const PoseConfig&) const = default;
};

/// Reads section [pose].
void readPose(TomlReader& file, PoseConfig& pose);

[[nodiscard]] std::optional<PoseOrigin> poseOrigin(std::string_view word);

/// The tag map that the configuration names; empty when it names none, or when poses come from
/// somewhere else. Throws Failure(NoInput) when the file is not there, Failure(BadData) when it is
/// wrong.
[[nodiscard]] TagMap configuredTags(const PoseConfig& pose);

/// The same for a file. Throws Failure as above.
[[nodiscard]] TagMap readTagMap(const std::filesystem::path& file);

/// What the tracker is to do with this map, for video of this rate [Hz].
[[nodiscard]] TrackerOptions trackerOptions(const PoseConfig& pose, TagMap map, double rateHz);

}  // namespace mfar
