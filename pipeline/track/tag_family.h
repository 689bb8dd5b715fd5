#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <string_view>

namespace mfar {

/// Supported families of AprilTags.
enum class TagFamily : unsigned char { Tag36h11, Tag25h9, Tag16h5, TagStandard41h12 };

struct TagFamilyInfo {
    TagFamily family;
    std::string_view name;  ///< as in tags.toml and in libapriltag
    int count;              ///< ids are 0 .. count - 1
    int cells;              ///< data cells along the edge between two corners
    bool brightInside;      ///< just inside the corners is a white ring, outside a black one
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

/// Identifies a tag uniquely.
struct TagKey {
    TagFamily family = TagFamily::Tag36h11;
    int id = 0;
    auto operator<=>(const TagKey&) const = default;
};

}  // namespace mfar
