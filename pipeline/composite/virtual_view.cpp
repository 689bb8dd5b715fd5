#include "pipeline/composite/virtual_view.h"

#include "pipeline/results.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// Real depth is also needed this far around the silhouette [video px], because the edges of depth
// are aligned with the edges of the picture there.
constexpr int kMargin = 8;
// Depth is not measured where it is known to lie behind an object. After this number of frames it
// is measured again, because something may have moved in front of the object.
constexpr int kMostRelied = 8;
// The camera counts as at rest while the objects move by less than this in the picture [px],
// because poses from tags are not more accurate.
constexpr double kLeastMotion = 0.3;
// Upper limit of the unknown pixels in a tile whose objects count as hidden. With more unknown
// pixels, specks of the objects would be visible.
constexpr int kMostGaps = 4;
constexpr int kMostUnknown = kTileSize * kTileSize / 4;  // upper limit of a tile's unknown pixels

PixelRect tilesOf(const PixelRect& pixels, Size layer, Size video) {
    const auto tile = [](int pixel, int from, int to) {
        return static_cast<double>(pixel) * to / from / kTileSize;
    };
    // Colours are interpolated, so a pixel of the layer is visible beyond its own borders.
    return {static_cast<int>(std::floor(tile(pixels.x0 - 1, layer.width, video.width))),
            static_cast<int>(std::floor(tile(pixels.y0 - 1, layer.height, video.height))),
            static_cast<int>(std::ceil(tile(pixels.x1 + 1, layer.width, video.width))),
            static_cast<int>(std::ceil(tile(pixels.y1 + 1, layer.height, video.height)))};
}

/// Result of a test of the real surface at a pixel. Finding: the test's condition is met.
enum class Surface { Unknown, Finding, Other };

struct TileBounds {
    int findings, unknown;  // numbers of pixels
};

/// True if a tile has more findings or more unknown pixels than `most`. `ask` classifies a pixel,
/// given its index in the picture.
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

VirtualView::VirtualView(const CameraModel& video, Size output, Engine& occludes)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      preview_(std::make_unique<PreviewRenderer>(video, output)),
      occlusion_(occludes.occlusion(output)), focal_(std::max(video.fx, video.fy)) {}

VirtualView::VirtualView(const CameraModel& video, Engine& occludes, TracedLayerOptions options)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      traced_(std::make_unique<TracedLayer>(video, occludes, options)),
      occlusion_(occludes.occlusion(options.size)), focal_(std::max(video.fx, video.fy)) {}

void VirtualView::setScene(std::shared_ptr<const Scene> scene) {
    // A scene that replaces another becomes visible only when its first picture is finished, so it
    // is not a change yet.
    if (!scene || !scene_) changed_ = true;
    if (!scene || !scene_ || scene->objects != scene_->objects)
        boxes_ = scene ? SceneBoxes(*scene) : SceneBoxes();
    catcherBoxes_ = scene ? SceneBoxes(scene->catcher) : SceneBoxes();
    scene_ = scene;
    if (scene) traced_->setScene(std::move(scene));
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
    if (!T_world_video || (objects_.empty() && boxes_.world().empty())) return {};
    nearest_ = 0;
    hidden_ = skips_.hiddenObjects;
    PixelRect decides;
    if (traced_) {
        addTiles(silhouette_.run(boxes_, *T_world_video), known, true, decides);
        if (!region_.empty())
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
        if (objects) hidden_ = hidden_ && isHidden(tile, nearest, known);
        if (!relies ||
            (objects ? mayHide(tile, farthest, known) : mayHideShadow(tile, nearest, known)))
            decides = around(decides, widened(tile, kTileSize, video_));
    }
}

// True if the real surface may be in front of the farthest virtual surface of the tile, within
// three standard deviations, or if too many pixels are unknown.
bool VirtualView::mayHide(const PixelRect& tile, float farthest,
                          const InverseDepthField& known) const {
    const float behind = 1 / farthest;
    return holdsMore({.findings = 0, .unknown = kMostUnknown}, tile, video_, [&](std::size_t i) {
        if (!known.isKnown(i)) return Surface::Unknown;
        const bool before = known.inverseDepth[i] + 3 * std::sqrt(known.variance[i]) >= behind;
        return before ? Surface::Finding : Surface::Other;
    });
}

// The real surface that a shadow falls onto is always close to the shadow and need not be measured
// every time. Depth is needed only for real things in front of the shadow, and where the error of
// depth exceeds kShadowLift.
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

// `nearest` includes the virtual surfaces around the tile, so only the tile's own pixels are
// tested.
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
    // While all objects are hidden, nothing is drawn. But the real things in front may move away,
    // so the objects' region is watched.
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
