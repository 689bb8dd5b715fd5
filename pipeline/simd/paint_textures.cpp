#include "pipeline/simd/paint_textures.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kLargestSide = 0x8000;  // [texels]; PaintLevel stores a side in 16 bits

std::size_t texelsOf(const PaintLevel& level) {
    return static_cast<std::size_t>(level.size & 0xFFFFU) * (level.size >> 16);
}

}  // namespace

void PaintTextures::addPicture(Picture& picture, const PaintSource& source) {
    picture.levels.clear();
    for (const PaintPicture& level : paintPyramid(source, kLargestSide)) {
        picture.levels.push_back(
            {static_cast<std::uint32_t>(texels_.size()),
             static_cast<std::uint32_t>(level.size.width | level.size.height << 16)});
        texels_.insert(texels_.end(), level.texels.begin(), level.texels.end());
    }
}

void PaintTextures::setPictures(std::span<const SilhouetteModels::Object> objects) {
    Pictures now;
    for (const SilhouetteModels::Object& object : objects)
        for (const SilhouetteModels::Part& part : object.shape->parts)
            now.try_emplace(paintSourceOf(part), Picture{object.shape->model, {}});
    const auto isKept = [this](const auto& entry) { return pictures_.contains(entry.first); };
    if (now.size() == pictures_.size() && std::ranges::all_of(now, isKept)) return;
    const Pictures before = std::exchange(pictures_, std::move(now));
    const std::vector<PaintWords> texels = std::exchange(texels_, {});
    for (auto& [source, picture] : pictures_) {
        if (const auto kept = before.find(source); kept != before.end()) {
            picture = kept->second;
            for (PaintLevel& level : picture.levels) {
                const auto from = texels.begin() + level.first;
                level.first = static_cast<std::uint32_t>(texels_.size());
                texels_.insert(texels_.end(), from,
                               from + static_cast<std::ptrdiff_t>(texelsOf(level)));
            }
        } else {
            addPicture(picture, source);
        }
    }
}

void PaintTextures::set(std::span<const SilhouetteModels::Object> objects) {
    setPictures(objects);
    levels_.clear();
    std::map<PaintSource, Material> made;
    for (const auto& [source, picture] : pictures_) {
        const auto first = static_cast<std::uint32_t>(levels_.size());
        const auto last = static_cast<std::uint32_t>(picture.levels.size() - 1);
        made[source] = {picture.levels.front().size, first | last << 24,
                        static_cast<std::uint32_t>(made.size())};
        levels_.insert(levels_.end(), picture.levels.begin(), picture.levels.end());
    }
    materials_.clear();
    for (const SilhouetteModels::Object& object : objects)
        for (const SilhouetteModels::Part& part : object.shape->parts)
            materials_[&part] = made.at(paintSourceOf(part));
}

}  // namespace mfar::simd
