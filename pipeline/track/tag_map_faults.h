#pragma once

#include "base/calibration/plausible_ranges.h"
#include "pipeline/track/tag_map.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>

namespace mfar {

/// The values of a tag as they are in a file of any format, before wrongWith() has checked them.
struct RawTag {
    TagFamily family = TagFamily::Tag36h11;
    std::int64_t id = -1;
    double size = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector4d wxyz{1, 0, 0, 0};
};

[[noreturn]] inline void tagMapFault(const std::string& file, int line, std::string_view what) {
    throw TagMapError(line > 0 ? fmt::format("{}:{}: {}", file, line, what)
                               : fmt::format("{}: {}", file, what));
}

/// A wrong value of a tag.
struct TagFault {
    std::string_view key;  ///< the RawTag's key in a TOML file
    std::string what;
};

/// Checks the values of a tag. If one is wrong or `seen` already contains the tag, returns a
/// description of the fault. Otherwise adds the tag to `seen` and returns nothing.
inline std::optional<TagFault> wrongWith(const RawTag& raw, std::set<TagKey>& seen) {
    const TagFamilyInfo& family = info(raw.family);
    if (raw.id < 0 || raw.id >= family.count)
        return TagFault{"id", fmt::format("id must be from 0 to {} in family {}, not {}",
                                          family.count - 1, family.name, raw.id)};
    if (!plausible::kTagSize.holds(raw.size))
        return TagFault{"size",
                        fmt::format("size must be from {} to {} m, not {}",
                                    plausible::kTagSize.least, plausible::kTagSize.most, raw.size)};
    for (const double coordinate : raw.position)
        if (!plausible::kTagPosition.holds(coordinate))
            return TagFault{"position", fmt::format("the position must be from {} to {} m, not {}",
                                                    plausible::kTagPosition.least,
                                                    plausible::kTagPosition.most, coordinate)};
    // tomlOf() writes nine decimals. Rounding to them cannot change the length by 1e-3.
    if (!(std::abs(raw.wxyz.norm() - 1) < 1e-3))
        return TagFault{"orientation",
                        fmt::format("the quaternion must have length 1, not {}", raw.wxyz.norm())};
    if (!seen.insert({raw.family, static_cast<int>(raw.id)}).second)
        return TagFault{"id", fmt::format("tag {} of family {} occurs twice", raw.id, family.name)};
    return std::nullopt;
}

inline MappedTag mapped(const RawTag& raw) {
    const Eigen::Vector4d& q = raw.wxyz;
    return {{raw.family, static_cast<int>(raw.id)},
            raw.size,
            {Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized(), raw.position}};
}

}  // namespace mfar
