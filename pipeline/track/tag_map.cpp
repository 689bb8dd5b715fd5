#include "pipeline/track/tag_map.h"

#include "base/bounded_file.h"
#include "base/se3.h"
#include "pipeline/track/tag_map_faults.h"

#include <cmath>
#include <string>

namespace mfar {
namespace {

constexpr std::size_t kLargestFile = 4U << 20U;  // [bytes]; the largest useful map has 0.4 MB

std::string readAll(const std::filesystem::path& file) {
    try {
        return boundedText(file, kLargestFile);
    } catch (const std::runtime_error& error) {
        tagMapFault(file.string(), 0, error.what());
    }
}

}  // namespace

TagMap::TagMap(const std::vector<MappedTag>& tags) {
    for (const MappedTag& one : tags) {
        if (!(one.size > 0) || !std::isfinite(one.size) || !isFinite(one.T_world_tag))
            throw std::invalid_argument(
                "tag map: the size of each tag must be positive, and its pose finite");
        if (!tags_.emplace(one.tag, one).second)
            throw std::invalid_argument("tag map: tag " + std::to_string(one.tag.id) +
                                        " occurs twice");
    }
}

const MappedTag* TagMap::find(TagKey tag) const {
    const auto it = tags_.find(tag);
    return it == tags_.end() ? nullptr : &it->second;
}

std::vector<TagFamily> TagMap::families() const {
    std::vector<TagFamily> out;
    for (const auto& [key, tag] : tags_)
        if (out.empty() || out.back() != key.family) out.push_back(key.family);
    return out;
}

bool isRosTagMap(const std::filesystem::path& file) {
    return file.extension() == ".yaml" || file.extension() == ".yml";
}

TagMap loadTagMap(const std::filesystem::path& file, TagFamily ofRosMap) {
    const std::string text = readAll(file);
    if (isRosTagMap(file)) return tagMapFromRosYaml(text, file.string(), ofRosMap);
    return tagMapFromToml(text, file.string());
}

}  // namespace mfar
