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

/// Virtual objects in the picture of the real scene. Determines where real depth is needed to
/// decide which parts of the objects are visible, and draws the objects over the picture.
class VirtualView {
public:
    /// Objects are drawn by the preview renderer. `occludes` creates the occlusion step and, for
    /// path-traced objects, the warp step. It must outlive this object.
    VirtualView(const CameraModel& video, Size output, Engine& occludes);
    /// Objects are path-traced. Throws the same exceptions as TracedLayer.
    VirtualView(const CameraModel& video, Engine& occludes, TracedLayerOptions options);

    /// Takes effect with the next place(). Only for the preview.
    void setObjects(std::vector<VirtualObject> objects);
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    /// The scene becomes visible when its first picture is finished; null: nothing is shown. Only
    /// for path tracing.
    void setScene(std::shared_ptr<const Scene> scene);
    /// Null if the preview draws the objects.
    [[nodiscard]] TracedLayer* traced() { return traced_.get(); }

    /// Places the objects for a camera at this pose; without a pose, they are not shown. Returns
    /// the video pixels whose real depth decides which parts of the objects are visible. `known`:
    /// approximate depth of the real scene, seen by the camera. Returns an empty area if no object
    /// is in the picture. In most frames, the area is also empty if the known depth certainly lies
    /// behind all objects.
    PixelRect place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                    const InverseDepthField& known);
    /// Bounds of all placed objects [video px].
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// True if the real scene hides all placed objects completely. Shadows are ignored.
    [[nodiscard]] bool isHidden() const { return hidden_; }
    /// Returns which changes of the picture make it necessary to redraw the objects. If the objects
    /// were changed, appeared or disappeared, they are always redrawn. If the camera has moved,
    /// they are redrawn with any change. Otherwise, only changes near the objects count.
    [[nodiscard]] WorkPlan::Redraw redraw() const;
    /// Tiles that have to be redrawn, if the objects are, before the next draw().
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws the placed objects over the picture. `real`: depth of the real scene, which is unknown
    /// outside `where`.
    void draw(const InverseDepthField& real, const PixelRect& where, const VideoFrame& frame,
              Field<std::uint32_t>& picture);

    /// Returns the share of the virtual objects in the colour of every output pixel, as drawn last.
    /// Waits for the GPU.
    [[nodiscard]] std::vector<float> readShown(Size output) const;

private:
    /// Adds tiles with virtual surfaces to region_, and those whose real depth has to be measured
    /// to `decides`.
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
    std::unique_ptr<TracedLayer> traced_;  // either this or preview_ is null
    std::unique_ptr<OcclusionStep> occlusion_;
    CompositeOptions hiding_;
    double focal_, nearest_ = 0;  // focal length [px]; largest inverse depth of objects [1/m]
    std::optional<RigidTransform> placedPose_, drawnPose_;
    PixelRect region_, drawn_;  // [video px], [tiles]
    TextureLayer previewLayer_;
    LayerPicture* layer_ = nullptr;  // the layer that was drawn last
    int relied_ = 0;                 // number of consecutive frames in which known depth was used
    bool changed_ = false, hidden_ = false, shown_ = false;
};

}  // namespace mfar
