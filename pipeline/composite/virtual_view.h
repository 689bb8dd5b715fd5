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

/// Virtual objects in the picture of the real scene: determines where real depth is needed for
/// them, and draws them over the picture.
class VirtualView {
public:
    /// Objects are drawn by the preview renderer. `occludes` makes the occlusion step and, for
    /// path-traced objects, the warp step; it must outlive this.
    VirtualView(const CameraModel& video, Size output, Engine& occludes);
    /// For path-traced objects. Throws as TracedLayer does.
    VirtualView(const CameraModel& video, Engine& occludes, TracedLayerOptions options);

    /// Takes effect with the next place(). Only with the preview.
    void setObjects(std::vector<VirtualObject> objects);
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    /// Visible as soon as it has been rendered; null: nothing. Only with path tracing.
    void setScene(std::shared_ptr<const Scene> scene);
    /// Null with the preview.
    [[nodiscard]] TracedLayer* traced() { return traced_.get(); }

    /// Places the objects for a camera at this pose; without a pose they are not shown. Returns the
    /// video pixels whose real depth decides which parts are visible. Empty if no object is in the
    /// picture, or if `known`, the approximate real scene seen by the camera, certainly lies behind
    /// all of them; this shortcut is not taken in every frame.
    PixelRect place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                    const InverseDepthField& known);
    /// Video pixels around all placed objects.
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// True when the real scene hides all placed objects completely. Shadows are ignored.
    [[nodiscard]] bool hidden() const { return hidden_; }
    /// When the objects have to be redrawn: always after objects were changed, appeared or
    /// disappeared; with any other change when the camera has moved.
    [[nodiscard]] WorkPlan::Redraw redraw() const;
    /// Tiles of the picture to redraw before the next draw().
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws the placed objects over the picture. `real` is unknown outside `where`.
    void draw(const InverseDepthField& real, const PixelRect& where, const VideoFrame& frame,
              Field<std::uint32_t>& picture);

    /// Share of virtual objects in every output pixel, as last drawn. Waits for the GPU.
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
    std::unique_ptr<TracedLayer> traced_;  // either this or preview_
    std::unique_ptr<OcclusionStep> occlusion_;
    CompositeOptions hiding_;
    double focal_, nearest_ = 0;  // [px]; largest inverse depth of the placed objects [1/m]
    std::optional<RigidTransform> placedPose_, drawnPose_;
    PixelRect region_, drawn_;  // [video px], [tiles]
    TextureLayer previewLayer_;
    LayerPicture* layer_ = nullptr;  // as last drawn
    int relied_ = 0;                 // consecutive frames that relied on known depth
    bool changed_ = false, hidden_ = false, shown_ = false;
};

}  // namespace mfar
