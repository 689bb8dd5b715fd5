#include "pipeline/composite/virtual_view.h"

#include "pipeline/results.h"
#include "pipeline/work_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// Real depth is needed where it is looked up for a pixel at the silhouette, with what snaps it to
// the picture's edges [video px].
constexpr int kMargin = 8;

PixelRect tilesOf(const PixelRect& pixels, Size output, Size video) {
    const auto tile = [](int pixel, int from, int to) {
        return static_cast<double>(pixel) * to / from / kTileSize;
    };
    return {static_cast<int>(std::floor(tile(pixels.x0, output.width, video.width))),
            static_cast<int>(std::floor(tile(pixels.y0, output.height, video.height))),
            static_cast<int>(std::ceil(tile(pixels.x1, output.width, video.width))),
            static_cast<int>(std::ceil(tile(pixels.y1, output.height, video.height)))};
}

}  // namespace

VirtualView::VirtualView(const CameraModel& video, Size output)
    : video_(video.size), silhouette_(video, kMargin), renderer_(video, output),
      composite_(video.size, output), depth_(video.size, gpu::TexelFormat::Rg32F),
      values_(2UL * video.size.width * video.size.height) {}

void VirtualView::setObjects(std::vector<VirtualObject> objects) {
    objects_ = std::move(objects);
    changed_ = true;
}

const PixelRect& VirtualView::place(const std::optional<RigidTransform>& T_world_video) {
    placedPose_ = T_world_video;
    region_ = {};
    if (!T_world_video || objects_.empty()) return region_;
    const auto& tiles = silhouette_.run(objects_, *T_world_video);
    const Size count = silhouette_.tileCount();
    PixelRect covered{count.width, count.height, 0, 0};
    for (int i = 0; i < count.width * count.height; ++i) {
        if (!(tiles[static_cast<std::size_t>(i)].farthest > 0)) continue;
        const int x = i % count.width, y = i / count.width;
        covered = {std::min(covered.x0, x), std::min(covered.y0, y), std::max(covered.x1, x + 1),
                   std::max(covered.y1, y + 1)};
    }
    if (!covered.empty())
        region_ = {covered.x0 * kTileSize, covered.y0 * kTileSize,
                   std::min(covered.x1 * kTileSize, video_.width),
                   std::min(covered.y1 * kTileSize, video_.height)};
    return region_;
}

bool VirtualView::mustRedraw() const {
    return changed_ || placed_ == region_.empty();
}

PixelRect VirtualView::staleTiles() const {
    if (!mustRedraw() || region_.empty()) return drawn_;
    return around(drawn_, tilesAround(region_));
}

void VirtualView::draw(const InverseDepthField& real, const gpu::Texture& video,
                       const gpu::Texture& picture, const gpu::Framebuffer& target) {
    changed_ = false;
    placed_ = !region_.empty();
    drawn_ = {};
    if (region_.empty()) return;
    layer_ = renderer_.render(objects_, *placedPose_);
    if (layer_.bounds.empty()) return;
    upload(real);
    composite_.run(layer_, depth_, video, picture, target);
    drawn_ = tilesOf(layer_.bounds, picture.size(), video_);
}

std::vector<float> VirtualView::readShown() const {
    const Size size = composite_.visibility().size();
    std::vector<float> out(static_cast<std::size_t>(size.width) * size.height);
    if (drawn_.empty()) return out;
    const auto visible = composite_.visibility().readRgba8(), colour = layer_.colour->readRgba8();
    for (int y = layer_.bounds.y0; y < layer_.bounds.y1; ++y) {
        for (int x = layer_.bounds.x0; x < layer_.bounds.x1; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            out[i] = static_cast<float>(visible[4 * i] * colour[4 * i + 3]) / (255.0F * 255.0F);
        }
    }
    return out;
}

void VirtualView::upload(const InverseDepthField& real) {
    for (std::size_t i = 0; i < real.rho.size(); ++i) {
        const bool known = real.isKnown(i);
        values_[2 * i] = known ? real.rho[i] : 0.0F;
        values_[2 * i + 1] = known ? std::sqrt(real.variance[i]) : -1.0F;
    }
    depth_.upload(values_);
}

}  // namespace mfar
