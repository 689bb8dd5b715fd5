#include "pipeline/warp/rerendered_pictures.h"

#include <algorithm>
#include <cassert>
#include <ranges>
#include <span>

namespace mfar {
namespace {

bool isObject(const HoleAnswer& answer, std::size_t i) {
    const float z = answer.depth[i];
    return answer.id[i] != 0 && answer.id[i] != kCatcherId && z > LensProjection::kNear &&
           z < kFarthestSurface;
}

}  // namespace

RerenderedPictures::RerenderedPictures(Size layer, int fadeFrames)
    : layer_(layer), fadeFrames_(fadeFrames),
      colours_(static_cast<std::size_t>(layer.width) * layer.height), surfaces_(colours_.size()) {
    for (int i = 0; i < kPictures; ++i)
        pictures_[i].slot = i;
}

void RerenderedPictures::clear() {
    for (Picture& picture : pictures_)
        picture.share = 0;
}

void RerenderedPictures::age() {
    const double step = fadeFrames_ > 0 ? 1.0 / fadeFrames_ : 1;
    for (Picture& picture : pictures_)
        if (picture.share > 0) picture.share = std::min(1.0, picture.share + step);
}

void RerenderedPictures::add(const HoleAnswer& answer,
                             const std::function<void(const StoredRows&)>& store) {
    const auto& pixels = answer.pixels;
    const auto indices = std::views::iota(std::size_t{0}, pixels.size());
    if (std::ranges::none_of(indices, [&](std::size_t i) { return isObject(answer, i); })) return;
    std::rotate(pictures_.begin(), pictures_.end() - 1, pictures_.end());
    Picture& picture = pictures_.front();
    PixelRect bounds;
    if (!answer.light.empty()) lights_.resize(surfaces_.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        assert(pixels[i] < surfaces_.size());
        const auto x = static_cast<int>(pixels[i] % static_cast<unsigned>(layer_.width));
        const auto y = static_cast<int>(pixels[i] / static_cast<unsigned>(layer_.width));
        if (isObject(answer, i)) {
            const float z = answer.depth[i];
            surfaces_[pixels[i]] = {z, static_cast<float>(answer.id[i]), 0, 1};
            colours_[pixels[i]] = filled(answer.colour[i]);
            if (!answer.light.empty()) lights_[pixels[i]] = answer.light[i];
        }
        bounds = around(bounds, {x, y, x + 1, y + 1});
    }
    for (const std::uint32_t i : pixels)
        surfaces_[i].tolerance = toleranceAt(
            surfaces_, layer_, static_cast<int>(i % static_cast<unsigned>(layer_.width)),
            static_cast<int>(i / static_cast<unsigned>(layer_.width)));
    const PixelRect rows = around(bounds, picture.bounds);
    store(rowsOf(picture.slot, rows.y0, rows.y1));
    for (const std::uint32_t i : pixels) {
        surfaces_[i] = {};
        colours_[i] = {};
        if (!lights_.empty()) lights_[i] = {};
    }
    picture = {picture.slot, answer.view.T_world_camera, bounds,
               fadeFrames_ > 0 ? 1.0 / fadeFrames_ : 1, answer.poses};
}

RerenderedPictures::StoredRows RerenderedPictures::rowsOf(int slot, int firstRow,
                                                          int lastRow) const {
    const std::size_t width = layer_.width;
    const std::size_t first = firstRow * width, count = (lastRow - firstRow) * width;
    return {slot,
            firstRow,
            lastRow,
            std::span(colours_).subspan(first, count),
            lights_.empty() ? std::span<const LightWords>()
                            : std::span(lights_).subspan(first, count),
            std::span(surfaces_).subspan(first, count)};
}

}  // namespace mfar
