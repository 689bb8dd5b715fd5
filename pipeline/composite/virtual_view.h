#pragma once

#include "pipeline/composite/preview_renderer.h"
#include "pipeline/composite/scene_boxes.h"
#include "pipeline/composite/silhouette.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/engine/engine.h"
#include "pipeline/engine/occlusion_options.h"
#include "pipeline/gles/texture_layer.h"
#include "pipeline/plan/work_plan.h"
#include "pipeline/skip_options.h"
#include "pipeline/traced_layer.h"

#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Virtual objects in the picture of the real scene: where real depth decides about them, and their
/// drawing over the picture.
class VirtualView {
public:
    /// Objects are drawn by the preview renderer; `occludes` makes the step that lays them over the
    /// picture, and where they are path traced the one that warps them. It must outlive this.
    VirtualView(const CameraModel& video, Size output, Engine& occludes);
    /// They are path traced. Throws as TracedLayer does.
    VirtualView(const CameraModel& video, Engine& occludes, TracedLayerOptions options);

    /// Shown from the next place() on. Of a view with preview.
    void setObjects(std::vector<VirtualObject> objects);
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    /// Shown as soon as there is a picture of it. Of a view that is path traced; null: nothing.
    void setScene(std::shared_ptr<const Scene> scene);
    /// Null with preview.
    [[nodiscard]] TracedLayer* traced() { return traced_.get(); }

    /// Where the objects are for a camera at this pose; nothing: they are not shown. Gives the
    /// video pixels whose real depth decides what of them is seen: empty where none is in the
    /// picture, or where all that is `known`, the real scene about as the camera sees it, surely
    /// lies behind them. From time to time that is not relied on.
    PixelRect place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                    const InverseDepthField& known);
    /// Video pixels around all objects, as placed.
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// Nothing of them is seen, as placed: real things are before them everywhere. Their shadows,
    /// where any are, do not count.
    [[nodiscard]] bool hidden() const { return hidden_; }
    /// When they have to be drawn anew: always after other objects, or when there are any after
    /// none and the other way round; with any change when the camera has moved.
    [[nodiscard]] WorkPlan::Redraw redraw() const;
    /// Tiles of the picture to draw anew before the next draw().
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws them, as placed, over the picture. `real` is unknown outside of `where`.
    void draw(const InverseDepthField& real, const PixelRect& where, const VideoFrame& frame,
              Field<std::uint32_t>& picture);

    /// Share of every output pixel that shows a virtual object, as last drawn. Waits for the GPU.
    [[nodiscard]] std::vector<float> readShown(Size output) const;

private:
    /// Adds tiles with virtual surfaces to the region and to `decides`.
    void addTiles(const std::vector<SurfaceRange>& tiles, const InverseDepthField& known,
                  bool objects, PixelRect& decides);
    [[nodiscard]] bool shows() const { return !region_.empty() && !hidden_; }
    [[nodiscard]] bool isStale() const { return shows() && traced_ && traced_->isStale(); }
    [[nodiscard]] bool mustRedraw() const { return changed_ || shown_ != shows() || isStale(); }
    [[nodiscard]] bool mayHide(const PixelRect& tile, float farthest,
                               const InverseDepthField& known) const;
    [[nodiscard]] bool mayHideShadow(const PixelRect& tile, float nearest,
                                     const InverseDepthField& known) const;
    [[nodiscard]] bool isHidden(const PixelRect& tile, float nearest,
                                const InverseDepthField& known) const;
    LayerPicture& renderPreview();

    Size video_;
    SkipOptions skips_;
    std::vector<VirtualObject> objects_;
    std::shared_ptr<const Scene> scene_;
    SceneBoxes boxes_, catcherBoxes_;
    Silhouette silhouette_, catcherSilhouette_;
    std::unique_ptr<PreviewRenderer> preview_;
    std::unique_ptr<TracedLayer> traced_;  // one of the two
    std::unique_ptr<OcclusionStep> occlusion_;
    CompositeOptions hiding_;
    double focal_, nearest_ = 0;  // [px]; of the objects' inverse depths, as placed [1/m]
    std::optional<RigidTransform> placedPose_, drawnPose_;
    PixelRect region_, drawn_;  // video pixels, tiles
    TextureLayer previewLayer_;
    LayerPicture* layer_ = nullptr;  // as last drawn
    int relied_ = 0;                 // frames in a row on what was known before
    bool changed_ = false, hidden_ = false, shown_ = false;
};

}  // namespace mfar
