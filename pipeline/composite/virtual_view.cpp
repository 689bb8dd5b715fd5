#include "pipeline/composite/virtual_view.h"

#include "pipeline/results.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// Real depth is also measured within this distance of the objects [video px], because EdgeSnap
// needs it there.
constexpr int kMargin = 8;
// Largest number of consecutive frames in which depth is not measured because the real surface is
// known to lie behind the objects. Then depth is measured again, because something may have moved
// in front of the objects.
constexpr int kMostRelied = 8;
// Objects that moved in the picture by at most this [px] count as unmoved, because errors of the
// camera's pose move them by as much.
constexpr double kLeastMotion = 0.3;
// The objects in a tile count as hidden only if at most this number of the tile's pixels have
// unknown depth. Unknown depth hides nothing, so specks of an object are visible at these pixels.
constexpr int kMostGaps = 4;
// Depth is measured in a tile if more than this number of its pixels have unknown depth.
constexpr int kMostUnknown = kTileSize * kTileSize / 4;

PixelRect tilesOf(const PixelRect& pixels, Size layer, Size video) {
    const auto tile = [](int pixel, int from, int to) {
        return static_cast<double>(pixel) * to / from / kTileSize;
    };
    // Colours are interpolated, so a pixel of the layer is also visible outside its own borders.
    return {static_cast<int>(std::floor(tile(pixels.x0 - 1, layer.width, video.width))),
            static_cast<int>(std::floor(tile(pixels.y0 - 1, layer.height, video.height))),
            static_cast<int>(std::ceil(tile(pixels.x1 + 1, layer.width, video.width))),
            static_cast<int>(std::ceil(tile(pixels.y1 + 1, layer.height, video.height)))};
}

/// Result of a test of the real surface at a pixel. Unknown: its depth is not known. Finding: the
/// surface has the property that the test looks for. Other: it does not have this property.
enum class Surface { Unknown, Finding, Other };

struct TileBounds {
    int findings, unknown;
};

/// True if a tile has more pixels with Surface::Finding or with Surface::Unknown than `most`
/// allows. `ask` tests the pixel with the given index.
template <typename Ask>
bool holdsMore(const TileBounds& most, const PixelRect& tile, Size video, const Ask& ask) {
    TileBounds found{};
    for (int y = tile.y0; y < std::min(tile.y1, video.height); ++y) {
        for (int x = tile.x0; x < std::min(tile.x1, video.width); ++x) {
            const Surface surface = ask(static_cast<std::size_t>(y) * video.width + x);
            if (surface == Surface::Unknown && ++found.unknown > most.unknown) return true;
            if (surface == Surface::Finding && ++found.findings > most.findings) return true;
        }
    }
    return false;
}

}  // namespace

VirtualView::VirtualView(const CameraModel& video, Size output, Engine& engine)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      preview_(std::make_unique<PreviewRenderer>(video, output)),
      occlusion_(engine.occlusion(output)), focal_(std::max(video.fx, video.fy)) {}

VirtualView::VirtualView(const CameraModel& video, Engine& engine, TracedLayerOptions options)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      traced_(std::make_unique<TracedLayer>(video, engine, options)),
      occlusion_(engine.occlusion(options.size)), focal_(std::max(video.fx, video.fy)) {}

void VirtualView::setScene(std::shared_ptr<const Scene> scene) {
    // Exchanging one scene for another does not set changed_: the new scene only becomes visible
    // with its first traced picture.
    if (!scene_) changed_ = true;
    if (!scene_ || scene->objects != scene_->objects) boxes_ = SceneBoxes(*scene);
    catcherBoxes_ = SceneBoxes(scene->catcher);
    scene_ = scene;
    traced_->setScene(std::move(scene));
}

void VirtualView::setObjects(std::vector<VirtualObject> objects) {
    objects_ = std::move(objects);
    changed_ = true;
}

PixelRect VirtualView::place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                             const InverseDepthField& known) {
    placedPose_ = T_world_video;
    region_ = {};
    hidden_ = false;
    if (!T_world_video || (objects_.empty() && boxes_.empty())) return {};
    nearest_ = 0;
    hidden_ = skips_.hiddenObjects;
    PixelRect decides;
    if (traced_) {
        boxes_.setTime(time);
        addTiles(silhouette_.run(boxes_, *T_world_video), known, true, decides);
        addTiles(catcherSilhouette_.run(catcherBoxes_, *T_world_video), known, false, decides);
    } else {
        addTiles(silhouette_.run(objects_, *T_world_video), known, true, decides);
    }
    hidden_ = hidden_ && !region_.empty();
    relied_ = relied_ < kMostRelied ? relied_ + 1 : 0;
    if (traced_ && shows()) traced_->update(*T_world_video, time);
    return decides.empty() ? decides : common(decides, region_);
}

void VirtualView::addTiles(const std::vector<SurfaceRange>& tiles, const InverseDepthField& known,
                           bool objects, PixelRect& decides) {
    const int columns = silhouette_.tileCount().width;
    const bool relies = skips_.knownBehind && relied_ < kMostRelied;
    for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
        const auto [nearest, farthest] = tiles[static_cast<std::size_t>(i)];
        if (!(farthest > 0)) continue;
        nearest_ = std::max(nearest_, 1.0 / nearest);
        const int x = i % columns * kTileSize, y = i / columns * kTileSize;
        const PixelRect tile{x, y, x + kTileSize, y + kTileSize};
        region_ = around(region_, widened(tile, 0, video_));
        hidden_ = hidden_ && isHidden(tile, nearest, known);
        if (!relies ||
            (objects ? mayHide(tile, farthest, known) : mayHideShadow(tile, nearest, known)))
            decides = around(decides, widened(tile, kTileSize, video_));
    }
}

// True if the real surface may be in front of the tile's farthest virtual surface (within three
// standard deviations), or if the depth of too many pixels is unknown.
bool VirtualView::mayHide(const PixelRect& tile, float farthest,
                          const InverseDepthField& known) const {
    const float behind = 1 / farthest;
    return holdsMore({.findings = 0, .unknown = kMostUnknown}, tile, video_, [&](std::size_t i) {
        if (!known.isKnown(i)) return Surface::Unknown;
        const bool before = known.inverseDepth[i] + 3 * std::sqrt(known.variance[i]) >= behind;
        return before ? Surface::Finding : Surface::Other;
    });
}

// The real surface under a shadow always has nearly the same depth as the shadow. So its depth is
// measured in only two cases: the known depth shows a real thing in front of the shadow at more
// than kMostGaps pixels, or the known depth has a relative error of at least kShadowLift at more
// than kMostUnknown pixels.
bool VirtualView::mayHideShadow(const PixelRect& tile, float nearest,
                                const InverseDepthField& known) const {
    const float before = 1 / nearest;
    const TileBounds most{.findings = kMostGaps, .unknown = kMostUnknown};
    return holdsMore(most, tile, video_, [&](std::size_t i) {
        const float sigma = std::sqrt(known.variance[i]);
        if (!(sigma < kShadowLift * known.inverseDepth[i])) return Surface::Unknown;
        return known.inverseDepth[i] - 3 * sigma > before ? Surface::Finding : Surface::Other;
    });
}

// True if the real surface certainly hides all virtual surfaces in and around the tile, whose
// smallest z is `nearest`. At most kMostGaps pixels of the tile may have unknown depth. At all
// others, the real surface must certainly be nearer than `nearest`.
bool VirtualView::isHidden(const PixelRect& tile, float nearest,
                           const InverseDepthField& known) const {
    const TileBounds most{.findings = 0, .unknown = kMostGaps};
    return !holdsMore(most, tile, video_, [&](std::size_t i) {
        if (!known.isKnown(i)) return Surface::Unknown;
        const float sigma = std::sqrt(known.variance[i]);
        return hiding_.hides(known.inverseDepth[i], sigma, 1 / nearest) ? Surface::Other
                                                                        : Surface::Finding;
    });
}

WorkPlan::Redraw VirtualView::redraw() const {
    using Redraw = WorkPlan::Redraw;
    if (mustRedraw() || (!skips_.objectsAtRest && shows())) return Redraw::Always;
    if (!placedPose_ || !drawnPose_) return Redraw::WithThem;
    const RigidTransform T = drawnPose_->inverse() * *placedPose_;
    const double turn = 2 * T.rotation.vec().norm();
    const bool moved = focal_ * (turn + nearest_ * T.translation.norm()) > kLeastMotion;
    return moved ? Redraw::WithOthers : Redraw::WithThem;
}

PixelRect VirtualView::staleTiles() const {
    // While the real scene hides all objects, none is drawn. Their tiles still count as stale,
    // because the real things in front of the objects may move away.
    const bool keepsAll = !mustRedraw() && !hidden_;
    if (keepsAll || region_.empty()) return drawn_;
    return around(drawn_, tilesAround(region_));
}

void VirtualView::draw(const InverseDepthField& real, const PixelRect& where,
                       const VideoFrame& frame, Field<std::uint32_t>& picture) {
    changed_ = false;
    shown_ = shows();
    drawnPose_ = placedPose_;
    drawn_ = {};
    if (!shown_) return;
    layer_ = traced_ ? &traced_->render(*placedPose_) : &renderPreview();
    if (layer_->bounds.empty()) return;
    const PixelRect bounds = layer_->bounds;
    const Size layer = layer_->colour.size();
    if (!skips_.objectBounds) layer_->bounds = {0, 0, layer.width, layer.height};
    occlusion_->draw(*layer_, real, where, frame, picture);
    layer_->bounds = bounds;
    drawn_ = common(tilesOf(layer_->bounds, layer, video_),
                    {0, 0, silhouette_.tileCount().width, silhouette_.tileCount().height});
}

LayerPicture& VirtualView::renderPreview() {
    const VirtualLayer& drawn = preview_->render(objects_, *placedPose_);
    return previewLayer_.show(*drawn.colour, *drawn.depth, drawn.bounds);
}

std::vector<float> VirtualView::readShown(Size output) const {
    std::vector<float> out(static_cast<std::size_t>(output.width) * output.height);
    if (drawn_.empty()) return out;
    const std::vector<float> visible = occlusion_->visibility();
    const Rows<const std::uint32_t> colour = layer_->colour.host();
    const Size layer = layer_->colour.size();
    const PixelRect& drawn = layer_->bounds;
    for (int y = 0; y < output.height; ++y) {
        const int v = static_cast<int>(static_cast<std::int64_t>(y) * layer.height / output.height);
        if (v < drawn.y0 || v >= drawn.y1) continue;
        for (int x = 0; x < output.width; ++x) {
            const int u =
                static_cast<int>(static_cast<std::int64_t>(x) * layer.width / output.width);
            if (u < drawn.x0 || u >= drawn.x1) continue;
            const std::size_t i = static_cast<std::size_t>(y) * output.width + x;
            out[i] = visible[i] * static_cast<float>(colour[v][u] >> 24) / 255;
        }
    }
    return out;
}

}  // namespace mfar
