#include "base/calibration/yaml_bounds.h"
#include "pipeline/track/tag_map.h"
#include "pipeline/track/tag_map_faults.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <initializer_list>

namespace mfar {
namespace {

/// Rotates tag coordinates (see MappedTag) to those of apriltag_ros (x right, y up, z out of the
/// surface). The rotation is half a turn about x.
const Eigen::Quaterniond kRosTagOfTag(0, 1, 0, 0);

class BundleReader {
public:
    BundleReader(std::string_view text, const std::string& file, TagFamily family)
        : file_(file), family_(family) {
        try {
            root_ = boundedYaml(std::string(text));
        } catch (const YAML::Exception& error) {
            tagMapFault(file, error.mark.line + 1, error.msg);
        }
    }

    TagMap read() {
        if (!root_.IsMap())
            tagMapFault(file_, 0, "the map has neither tag_bundles nor standalone_tags");
        checkKeys(root_, {"standalone_tags", "tag_bundles"});
        const std::vector<MappedTag> alone = readList(root_["standalone_tags"], false);
        const YAML::Node bundles = root_["tag_bundles"];
        if (isThere(bundles)) return TagMap(readBundles(bundles));
        if (alone.empty()) tagMapFault(file_, 0, "the map has no tag");
        if (alone.size() > 1)
            fail(root_["standalone_tags"], "there are several standalone tags but no bundle, so "
                                           "their relative positions are unknown");
        return TagMap(alone);
    }

private:
    static bool isThere(const YAML::Node& list) {
        return list.IsDefined() && !list.IsNull() && !(list.IsSequence() && list.size() == 0);
    }

    [[noreturn]] void fail(const YAML::Node& at, const std::string& what) const {
        tagMapFault(file_, at.Mark().line + 1, what);
    }

    void checkKeys(const YAML::Node& map, std::initializer_list<std::string_view> known) const {
        std::set<std::string> seen;
        for (const auto& entry : map) {
            if (!entry.first.IsScalar()) fail(entry.first, "a key must be a single value");
            const std::string& key = entry.first.Scalar();
            if (std::find(known.begin(), known.end(), key) == known.end())
                fail(entry.first, fmt::format("unknown key {}; expected one of {}", key,
                                              fmt::join(known, ", ")));
            if (!seen.insert(key).second) fail(entry.first, fmt::format("{} occurs twice", key));
        }
    }

    std::vector<MappedTag> readBundles(const YAML::Node& bundles) {
        if (!bundles.IsSequence()) fail(bundles, "tag_bundles must be a list");
        if (bundles.size() > 1)
            fail(bundles[1], "a second bundle is not supported: each bundle has its own coordinate "
                             "frame, and only one can be the world");
        const YAML::Node bundle = bundles[0];
        if (!bundle.IsMap()) fail(bundle, "a bundle must have the keys name and layout");
        checkKeys(bundle, {"name", "layout"});
        std::vector<MappedTag> tags = readList(bundle["layout"], true);
        if (tags.empty()) fail(bundle, "the map has no tag");
        return tags;
    }

    std::vector<MappedTag> readList(const YAML::Node& list, bool placed) {
        std::vector<MappedTag> out;
        if (!isThere(list)) return out;
        if (!list.IsSequence()) fail(list, "tags must be a list");
        for (const YAML::Node& node : list) {
            if (!node.IsMap()) fail(node, "a tag must have the keys id and size");
            const RawTag raw = readTag(node, placed);
            if (const auto wrong = wrongWith(raw, seen_)) fail(node, wrong->what);
            MappedTag tag = mapped(raw);
            tag.T_world_tag.rotation = (tag.T_world_tag.rotation * kRosTagOfTag).normalized();
            out.push_back(tag);
        }
        return out;
    }

    [[nodiscard]] RawTag readTag(const YAML::Node& node, bool placed) const {
        if (placed)
            checkKeys(node, {"id", "size", "x", "y", "z", "qw", "qx", "qy", "qz"});
        else
            checkKeys(node, {"id", "size", "name", "frame_id"});
        RawTag out;
        out.family = family_;
        const YAML::Node id = required(node, "id");
        if (!YAML::convert<std::int64_t>::decode(id, out.id)) fail(id, "id must be a whole number");
        out.size = number(required(node, "size"), "size");
        if (!placed) return out;
        out.position = {optional(node, "x", 0), optional(node, "y", 0), optional(node, "z", 0)};
        out.wxyz = {optional(node, "qw", 1), optional(node, "qx", 0), optional(node, "qy", 0),
                    optional(node, "qz", 0)};
        return out;
    }

    [[nodiscard]] YAML::Node required(const YAML::Node& map, const std::string& key) const {
        YAML::Node node = map[key];
        if (!node.IsDefined()) fail(map, fmt::format("a tag has no key {}", key));
        return node;
    }

    [[nodiscard]] double number(const YAML::Node& node, std::string_view key) const {
        double out = 0;
        if (!node.IsScalar() || !YAML::convert<double>::decode(node, out) || !std::isfinite(out))
            fail(node, fmt::format("{} must be a finite number", key));
        return out;
    }

    [[nodiscard]] double optional(const YAML::Node& map, const std::string& key,
                                  double otherwise) const {
        const YAML::Node node = map[key];
        return node.IsDefined() ? number(node, key) : otherwise;
    }

    const std::string& file_;
    TagFamily family_;
    YAML::Node root_;
    std::set<TagKey> seen_;
};

}  // namespace

TagMap tagMapFromRosYaml(std::string_view text, const std::string& file, TagFamily family) {
    return BundleReader(text, file, family).read();
}

}  // namespace mfar
