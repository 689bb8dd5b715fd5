#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <string_view>

namespace mfar {

enum class TagFamily : unsigned char { Tag36h11, Tag25h9, Tag16h5, TagStandard41h12 };

struct TagFamilyInfo {
    TagFamily family;
    std::string_view name;
    int count;          ///< ids are 0 to count - 1
    int cells;          ///< number of cells along an edge, from corner to corner
    bool brightInside;  ///< true: at the corners, cells inside are white, outside black
};

inline constexpr std::array<TagFamilyInfo, 4> kTagFamilies{{
    {TagFamily::Tag36h11, "tag36h11", 587, 8, false},
    {TagFamily::Tag25h9, "tag25h9", 35, 7, false},
    {TagFamily::Tag16h5, "tag16h5", 30, 6, false},
    {TagFamily::TagStandard41h12, "tagStandard41h12", 2115, 5, true},
}};

[[nodiscard]] constexpr const TagFamilyInfo& info(TagFamily family) {
    return kTagFamilies[static_cast<std::size_t>(family)];
}

[[nodiscard]] constexpr std::optional<TagFamily> tagFamilyNamed(std::string_view name) {
    for (const TagFamilyInfo& one : kTagFamilies)
        if (one.name == name) return one.family;
    return std::nullopt;
}

struct TagKey {
    TagFamily family = TagFamily::Tag36h11;
    int id = 0;
    auto operator<=>(const TagKey&) const = default;
};

}  // namespace mfar
