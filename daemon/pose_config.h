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

/// Where the camera's pose comes from.
enum class PoseOrigin {
    Tags,      ///< AprilTags in video and stills
    Recorded,  ///< the recording's poses
    None,      ///< no pose: every frame is matched in both dimensions
};

/// Section [pose] of the configuration.
struct PoseConfig {
    PoseOrigin source = PoseOrigin::Tags;
    /// Tag map. Empty: that of the source; if it has none, the largest tag of the first picture
    /// with tags defines the world frame, and `families` and `tagSize` describe the tags to detect.
    std::filesystem::path tags;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;         ///< [m]
    double decimation = 2;        ///< of the video: 1, 1.5 or a whole number up to 8
    int threads = 1;              ///< detector threads per sensor
    int fullSearchInterval = 15;  ///< frames
    int bridgeFrames = 12;        ///< frames without a tag after which there is no pose

    bool operator==(const PoseConfig&) const = default;
};

/// Reads section [pose].
void readPose(TomlReader& file, PoseConfig& pose);

[[nodiscard]] std::optional<PoseOrigin> poseOrigin(std::string_view word);

/// The configured tag map; empty when none is configured, or when poses have another source. Throws
/// Failure(NoInput) when the file does not exist, Failure(BadData) when it is invalid.
[[nodiscard]] TagMap configuredTags(const PoseConfig& pose);

/// The same for a file. Throws Failure as above.
[[nodiscard]] TagMap readTagMap(const std::filesystem::path& file);

/// Options of the tracker for this map and for video of this rate [Hz].
[[nodiscard]] TrackerOptions trackerOptions(const PoseConfig& pose, TagMap map, double rateHz);

}  // namespace mfar
