#include "pipeline/composite/virtual_view.h"

#include "pipeline/results.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace mfar {
namespace {

// Real depth is needed where it is looked up for a pixel at the silhouette, with what snaps it to
// the picture's edges [video px].
constexpr int kMargin = 8;
// What is known to lie behind an object is measured again after so many frames at most: something
// may have come before it.
constexpr int kMostRelied = 8;
// A camera that moved the objects less has not moved [px]: tags do not know better at rest.
constexpr double kLeastMotion = 0.3;
// Pixels of a tile that may be unknown within what hides an object: specks of it would be seen.
constexpr int kMostGaps = 4;
constexpr int kMostUnknown = kTileSize * kTileSize / 4;  // pixels of a tile

PixelRect tilesOf(const PixelRect& pixels, Size layer, Size video) {
    const auto tile = [](int pixel, int from, int to) {
        return static_cast<double>(pixel) * to / from / kTileSize;
    };
    // Colours are interpolated: a pixel is seen beyond its own borders.
    return {static_cast<int>(std::floor(tile(pixels.x0 - 1, layer.width, video.width))),
            static_cast<int>(std::floor(tile(pixels.y0 - 1, layer.height, video.height))),
            static_cast<int>(std::ceil(tile(pixels.x1 + 1, layer.width, video.width))),
            static_cast<int>(std::ceil(tile(pixels.y1 + 1, layer.height, video.height)))};
}

/// What a pixel's real surface says to a question about its tile.
enum class Surface { Unknown, Finding, Other };

struct TileBounds {
    int findings, unknown;  // pixels
};

/// Whether a tile's pixels in the picture, asked one by one by their place in it, exceed one of
/// the bounds.
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

VirtualView::VirtualView(const CameraModel& video, Size output)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      preview_(std::make_unique<PreviewRenderer>(video, output)), composite_(video.size, output),
      depth_(video.size, gpu::TexelFormat::Rg32F),
      values_(2UL * video.size.width * video.size.height), focal_(std::max(video.fx, video.fy)),
      uploaded_{0, 0, video.size.width, video.size.height} {}

VirtualView::VirtualView(const CameraModel& video, Size output, TracedLayerOptions options)
    : video_(video.size), silhouette_(video, kMargin), catcherSilhouette_(video, kMargin),
      traced_(std::make_unique<TracedLayer>(video, options)),
      composite_(video.size, output, options.size), depth_(video.size, gpu::TexelFormat::Rg32F),
      values_(2UL * video.size.width * video.size.height), focal_(std::max(video.fx, video.fy)),
      uploaded_{0, 0, video.size.width, video.size.height} {}

void VirtualView::setScene(std::shared_ptr<const Scene> scene) {
    // What is shown changes when there is a picture of it.
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

// By three standard deviations; of what is not known it may be.
bool VirtualView::mayHide(const PixelRect& tile, float farthest,
                          const InverseDepthField& known) const {
    const float behind = 1 / farthest;
    return holdsMore({.findings = 0, .unknown = kMostUnknown}, tile, video_, [&](std::size_t i) {
        if (!known.isKnown(i)) return Surface::Unknown;
        const bool before = known.rho[i] + 3 * std::sqrt(known.variance[i]) >= behind;
        return before ? Surface::Finding : Surface::Other;
    });
}

// The surface that a shadow lies on is always close to it and need not be searched for anew each
// time: that is left to things before it, and to what kShadowLift does not make up for.
bool VirtualView::mayHideShadow(const PixelRect& tile, float nearest,
                                const InverseDepthField& known) const {
    const float before = 1 / nearest;
    const TileBounds most{.findings = kMostGaps, .unknown = kMostUnknown};
    return holdsMore(most, tile, video_, [&](std::size_t i) {
        const float sigma = std::sqrt(known.variance[i]);
        if (!(sigma < kShadowLift * known.rho[i])) return Surface::Unknown;
        return known.rho[i] - 3 * sigma > before ? Surface::Finding : Surface::Other;
    });
}

// The surfaces of a tile are those around it as well, so its samples are all that decide.
bool VirtualView::isHidden(const PixelRect& tile, float nearest,
                           const InverseDepthField& known) const {
    const TileBounds most{.findings = 0, .unknown = kMostGaps};
    return !holdsMore(most, tile, video_, [&](std::size_t i) {
        if (!known.isKnown(i)) return Surface::Unknown;
        const float sigma = std::sqrt(known.variance[i]);
        return composite_.hides(known.rho[i], sigma, 1 / nearest) ? Surface::Other
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
    // What hides all of them may go away.
    const bool keepsAll = !mustRedraw() && !hidden_;
    if (keepsAll || region_.empty()) return drawn_;
    return around(drawn_, tilesAround(region_));
}

void VirtualView::draw(const InverseDepthField& real, const PixelRect& where,
                       const gpu::Texture& video, const gpu::Texture& picture,
                       const gpu::Framebuffer& target) {
    changed_ = false;
    shown_ = shows();
    drawnPose_ = placedPose_;
    drawn_ = {};
    if (!shown_) return;
    layer_ = traced_ ? traced_->render(*placedPose_) : preview_->render(objects_, *placedPose_);
    if (layer_.bounds.empty()) return;
    const Size layer = layer_.colour->size();
    upload(real, where);
    VirtualLayer laid = layer_;
    if (!skips_.objectBounds) laid.bounds = {0, 0, layer.width, layer.height};
    composite_.run(laid, depth_, video, picture, target);
    drawn_ = common(tilesOf(layer_.bounds, layer, video_),
                    {0, 0, silhouette_.tileCount().width, silhouette_.tileCount().height});
}

std::vector<float> VirtualView::readShown() const {
    const Size size = composite_.visibility().size();
    std::vector<float> out(static_cast<std::size_t>(size.width) * size.height);
    if (drawn_.empty()) return out;
    const auto visible = composite_.visibility().readRgba8(), colour = layer_.colour->readRgba8();
    const Size layer = layer_.colour->size();
    const PixelRect& drawn = layer_.bounds;
    for (int y = 0; y < size.height; ++y) {
        const int v = static_cast<int>(static_cast<std::int64_t>(y) * layer.height / size.height);
        if (v < drawn.y0 || v >= drawn.y1) continue;
        for (int x = 0; x < size.width; ++x) {
            const int u = static_cast<int>(static_cast<std::int64_t>(x) * layer.width / size.width);
            if (u < drawn.x0 || u >= drawn.x1) continue;
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            const std::size_t j = static_cast<std::size_t>(v) * layer.width + u;
            out[i] = static_cast<float>(visible[4 * i] * colour[4 * j + 3]) / (255.0F * 255.0F);
        }
    }
    return out;
}

// Rows in which something is known, or was.
void VirtualView::upload(const InverseDepthField& real, const PixelRect& where) {
    const PixelRect rows = around(uploaded_, where);
    uploaded_ = where;
    if (rows.empty()) return;
    const std::size_t first = static_cast<std::size_t>(rows.y0) * video_.width;
    const std::size_t last = static_cast<std::size_t>(rows.y1) * video_.width;
    for (std::size_t i = first; i < last; ++i) {
        const bool known = real.isKnown(i);
        values_[2 * i] = known ? real.rho[i] : 0.0F;
        values_[2 * i + 1] = known ? std::sqrt(real.variance[i]) : -1.0F;
    }
    depth_.upload(std::span(values_).subspan(2 * first, 2 * (last - first)), rows.y0);
}

}  // namespace mfar
