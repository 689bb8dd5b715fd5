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

enum class PoseOrigin {
    Tags,
    Recorded,
    None,  ///< no poses: every frame is matched in both dimensions
};

struct PoseConfig {
    PoseOrigin source = PoseOrigin::Tags;
    /// Path of the tag map. If it is empty, the source's own tag map is used. If the source has
    /// none, `families` and `tagSize` describe the tags to detect. Then the largest tag with
    /// a usable pose defines the world frame.
    std::filesystem::path tags;
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    double tagSize = 0.1;  ///< edge of the tag that defines the world without a map [m]
    /// Tags are searched in video that is reduced by this factor: 1.5 or a whole number, 1 to 8.
    double decimation = 2;
    int threads = 1;
    int fullSearchInterval = 15;  ///< longest time between searches of the whole picture [frames]
    int bridgeFrames = 12;        ///< longest prediction of poses without tags [frames]

    bool operator==(const PoseConfig&) const = default;
};

void readPose(TomlReader& file, PoseConfig& pose);

[[nodiscard]] std::optional<PoseOrigin> poseOrigin(std::string_view word);

/// Returns the configured tag map. It is empty if no map is configured or pose.source is "none".
/// The map is read even with recorded poses, because objects on tags need it. Throws like
/// readTagMap(), and Failure(BadData) for the map of apriltag_ros if `families` does not have
/// exactly one family.
[[nodiscard]] TagMap configuredTags(const PoseConfig& pose);

/// Throws Failure(NoInput) if the file does not exist, Failure(BadData) if it is invalid.
/// `ofRosMap`: family of the tags in a map of apriltag_ros, which does not name it.
[[nodiscard]] TagMap readTagMap(const std::filesystem::path& file,
                                TagFamily ofRosMap = TagFamily::Tag36h11);

/// `rateHz`: frames per second of the video; 0: unknown.
[[nodiscard]] TrackerOptions trackerOptions(const PoseConfig& pose, TagMap map, double rateHz);

}  // namespace mfar
