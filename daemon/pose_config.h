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

/// Where the camera's poses come from.
enum class PoseOrigin {
    Tags,      ///< AprilTags in video and stills
    Recorded,  ///< the poses in the recording
    None,      ///< there are no poses: every frame is matched in both dimensions
};

/// Section [pose] of the configuration.
struct PoseConfig {
    PoseOrigin source = PoseOrigin::Tags;
    /// Path of the tag map. If it is empty, the tag map of the source is used. If the source has
    /// none, the largest tag of the first picture with tags defines the world frame, and `families`
    /// and `tagSize` describe the tags to detect.
    std::filesystem::path tags;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;   ///< edge of the tag that defines the world frame [m]
    double decimation = 2;  ///< factor of reducing the video for the tag search: 1, 1.5, 2 to 8
    int threads = 1;        ///< number of detector threads per sensor
    int fullSearchInterval = 15;  ///< interval of tag searches in the whole picture [frames]
    int bridgeFrames = 12;        ///< longest prediction of poses without tags [frames]

    bool operator==(const PoseConfig&) const = default;
};

/// Reads section [pose].
void readPose(TomlReader& file, PoseConfig& pose);

[[nodiscard]] std::optional<PoseOrigin> poseOrigin(std::string_view word);

/// Returns the configured tag map. It is empty if no map is configured or if poses do not come from
/// tags. Throws like readTagMap().
[[nodiscard]] TagMap configuredTags(const PoseConfig& pose);

/// Reads a tag map. Throws Failure(NoInput) if the file does not exist, Failure(BadData) if it is
/// invalid.
[[nodiscard]] TagMap readTagMap(const std::filesystem::path& file);

/// Returns the tracker's options for this tag map and for a video of `rateHz` frames per second.
[[nodiscard]] TrackerOptions trackerOptions(const PoseConfig& pose, TagMap map, double rateHz);

}  // namespace mfar
