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

/// Thrown if a tag map is invalid. The message is one line. It begins with "file:line: ", or with
/// "file: " if the fault is not in a particular line.
class TagMapError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct MappedTag {
    TagKey tag;
    double size = 0;             ///< side of the square between the detected corners [m]
    RigidTransform T_world_tag;  ///< tag coordinates: x right, y down, z into the surface
};

/// Returns the transformation from coordinates of objects that stand on a tag to tag coordinates.
/// Object coordinates: x right and y up in the tag's print, z out of the print.
[[nodiscard]] inline RigidTransform standOnTag() {
    return {Eigen::Quaterniond(0, 1, 0, 0), Eigen::Vector3d::Zero()};
}

class TagMap {
public:
    TagMap() = default;
    /// Throws std::invalid_argument if a tag occurs twice, its size is not positive, or its size or
    /// pose is not finite.
    explicit TagMap(const std::vector<MappedTag>& tags);

    /// Returns null if the tag is not in the map. The result is valid as long as the map.
    [[nodiscard]] const MappedTag* find(TagKey tag) const;
    [[nodiscard]] bool empty() const { return tags_.empty(); }
    [[nodiscard]] const std::map<TagKey, MappedTag>& tags() const { return tags_; }
    [[nodiscard]] std::vector<TagFamily> families() const;

private:
    std::map<TagKey, MappedTag> tags_;
};

/// True if tagMapFromRosYaml() reads the file: its name ends with .yaml or .yml.
[[nodiscard]] bool isRosTagMap(const std::filesystem::path& file);

/// Reads a tag map from a file. If isRosTagMap(file), its tags are of the family `ofRosMap`. Any
/// other file is TOML like tags.toml: `family` for all tags, and a list `[[tags]]` with `id`,
/// `size` [m], `position` [x, y, z] [m] and `orientation` [w, x, y, z]. A tag of another family has
/// its own `family`. Throws TagMapError.
[[nodiscard]] TagMap loadTagMap(const std::filesystem::path& file,
                                TagFamily ofRosMap = TagFamily::Tag36h11);

/// Reads a tag map from TOML text. `file` is the file name for error messages. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromToml(std::string_view text, const std::string& file);

[[nodiscard]] std::string tomlOf(const TagMap& map);

/// Reads the tags.yaml of apriltag_ros (ROS 1). `tag_bundles` may have one entry, whose coordinates
/// become the world. Each tag in the `layout` of this entry has `id`, `size` and a pose x, y, z,
/// qw, qx, qy, qz (default: identity). Tags in `standalone_tags` have no pose in this world, so
/// they are only checked. If there is no bundle, there must be a single standalone tag. Its
/// coordinates become the world.
///
/// In the file's tag coordinates, y points up and z out of the surface. Poses are converted to the
/// tag coordinates of MappedTag. The file does not name the tag family, so it is the argument
/// `family`. Throws TagMapError.
[[nodiscard]] TagMap tagMapFromRosYaml(std::string_view text, const std::string& file,
                                       TagFamily family = TagFamily::Tag36h11);

}  // namespace mfar
