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

/// A tag map is wrong. One line that begins with "file:line: " (or "file: " where no line is to
/// blame).
class TagMapError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct MappedTag {
    TagKey tag;
    double size = 0;             ///< edge of the square between the detected corners [m]
    RigidTransform T_world_tag;  ///< tag frame: x right, y down, z into the surface
};

/// The frame of what stands on a tag, x to the right and y up in its print, z out of it -> the
/// tag's.
[[nodiscard]] inline RigidTransform standOnTag() {
    return {Eigen::Quaterniond(0, 1, 0, 0), Eigen::Vector3d::Zero()};
}

/// Where the tags of a world are. Its frame is the world of every pose.
class TagMap {
public:
    TagMap() = default;
    /// Throws std::invalid_argument for a tag that is there twice, a size that is not positive or a
    /// pose that is not finite.
    explicit TagMap(const std::vector<MappedTag>& tags);

    /// nullptr when it is not in the map. Valid as long as the map.
    [[nodiscard]] const MappedTag* find(TagKey tag) const;
    [[nodiscard]] bool empty() const { return tags_.empty(); }
    /// Sorted by family and id.
    [[nodiscard]] const std::map<TagKey, MappedTag>& tags() const { return tags_; }
    /// Families that occur in it.
    [[nodiscard]] std::vector<TagFamily> families() const;

private:
    std::map<TagKey, MappedTag> tags_;
};

/// Reads tags.toml: `family` for all tags, and a list `[[tags]]` with `id`, `size` [m], `position`
/// [x, y, z] [m], `orientation` [w, x, y, z] and, where it differs, `family`. Reads by its ending
/// .yaml or .yml the tags.yaml of apriltag_ros instead, see tagMapFromRosYaml. Throws TagMapError.
[[nodiscard]] TagMap loadTagMap(const std::filesystem::path& file);

/// `file` is for messages. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromToml(std::string_view text, const std::string& file);

/// The map as tags.toml.
[[nodiscard]] std::string tomlOf(const TagMap& map);

/// The tags.yaml of apriltag_ros (ROS 1): the one `tag_bundles` entry's `layout` with `id`, `size`
/// and x, y, z, qw, qx, qy, qz (identity when left out), whose frame becomes the world; tags in
/// `standalone_tags` have no place in it and are only checked. Without a bundle the one standalone
/// tag is the world. Its tag frame has y up and z out of the surface and is turned to ours. The
/// file does not name the family. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromRosYaml(std::string_view text, const std::string& file,
                                       TagFamily family = TagFamily::Tag36h11);

}  // namespace mfar
