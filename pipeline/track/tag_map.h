#pragma once

#include "base/geometry.h"
#include "pipeline/track/tag_family.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// A tag map is invalid. One line that begins with "file:line: " (or "file: " when the fault is not
/// in one line).
class TagMapError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct MappedTag {
    TagKey tag;
    double size = 0;             ///< edge of the square between the detected corners [m]
    RigidTransform T_world_tag;  ///< tag frame: x right, y down, z into the surface
};

/// From the frame of objects that stand on a tag (x to the right and y up in its print, z out of
/// it) to the tag's frame.
[[nodiscard]] inline RigidTransform standOnTag() {
    return {Eigen::Quaterniond(0, 1, 0, 0), Eigen::Vector3d::Zero()};
}

/// The poses of the tags in the world. Its frame is the world frame of all poses.
class TagMap {
public:
    TagMap() = default;
    /// Throws std::invalid_argument for a duplicate tag, a size that is not positive or a pose that
    /// is not finite.
    explicit TagMap(const std::vector<MappedTag>& tags);

    /// nullptr when the tag is not in the map. Valid as long as the map.
    [[nodiscard]] const MappedTag* find(TagKey tag) const;
    [[nodiscard]] bool empty() const { return tags_.empty(); }
    /// Sorted by family and id.
    [[nodiscard]] const std::map<TagKey, MappedTag>& tags() const { return tags_; }
    /// Families that occur in the map.
    [[nodiscard]] std::vector<TagFamily> families() const;

private:
    std::map<TagKey, MappedTag> tags_;
};

/// Reads tags.toml: `family` for all tags, and a list `[[tags]]` with `id`, `size` [m], `position`
/// [x, y, z] [m], `orientation` [w, x, y, z] and, where it differs, `family`. Files that end in
/// .yaml or .yml are read as the tags.yaml of apriltag_ros, see tagMapFromRosYaml. Throws
/// TagMapError.
[[nodiscard]] TagMap loadTagMap(const std::filesystem::path& file);

/// `file` is for messages. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromToml(std::string_view text, const std::string& file);

/// The map in the format of tags.toml.
[[nodiscard]] std::string tomlOf(const TagMap& map);

/// Reads the tags.yaml of apriltag_ros (ROS 1). The frame of the only `tag_bundles` entry becomes
/// the world; its `layout` has `id`, `size` and x, y, z, qw, qx, qy, qz (identity by default). Tags
/// in `standalone_tags` have no pose in that world and are only checked. Without a bundle, the only
/// standalone tag is the world. The file's tag frame has y up and z out of the surface and is
/// converted to ours. The file does not name the family. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromRosYaml(std::string_view text, const std::string& file,
                                       TagFamily family = TagFamily::Tag36h11);

}  // namespace mfar
