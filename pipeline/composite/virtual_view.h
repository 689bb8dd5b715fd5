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

/// Shows virtual objects in the picture of the real scene. Determines where real depth is needed to
/// decide which parts of the objects are visible, and draws the objects over the picture.
class VirtualView {
public:
    /// Creates a view whose objects the preview renderer draws. `occludes` creates the occlusion
    /// step. It must outlive this object.
    VirtualView(const CameraModel& video, Size output, Engine& occludes);
    /// Creates a view of path-traced objects. `occludes` creates the occlusion step and the warp
    /// step. It must outlive this object. Throws the same exceptions as TracedLayer.
    VirtualView(const CameraModel& video, Engine& occludes, TracedLayerOptions options);

    /// Sets the objects of the preview. Takes effect with the next place().
    void setObjects(std::vector<VirtualObject> objects);
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    /// Sets the scene for path tracing. It becomes visible when its first traced picture is
    /// finished. Null: nothing is shown.
    void setScene(std::shared_ptr<const Scene> scene);
    /// The path-traced layer; null if the preview draws the objects.
    [[nodiscard]] TracedLayer* traced() { return traced_.get(); }

    /// Places the objects for a camera at this pose; without a pose, they are not shown. Returns
    /// the rectangle of the video pixels whose real depth decides which parts of the objects are
    /// visible. `known`: approximate depth of the real scene, seen by the camera. Returns an empty
    /// area if no object is in the picture. In most frames, the area is also empty if the known
    /// depth certainly lies behind all objects.
    PixelRect place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                    const InverseDepthField& known);
    /// Bounds of all placed objects [video px].
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// True if the real scene hides all placed objects completely. Shadows are ignored.
    [[nodiscard]] bool isHidden() const { return hidden_; }
    /// Returns after which changes of the video the objects must be drawn again. If objects were
    /// changed, appeared or disappeared: always. If the camera has moved: after any change.
    /// Otherwise: only after changes near the objects.
    [[nodiscard]] WorkPlan::Redraw redraw() const;
    /// Tiles of the video that must be drawn again before the next draw(), if the objects are drawn
    /// again.
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws the placed objects over the picture. `real`: depth of the real scene, which is unknown
    /// outside `where`.
    void draw(const InverseDepthField& real, const PixelRect& where, const VideoFrame& frame,
              Field<std::uint32_t>& picture);

    /// Returns how much the virtual objects covered each output pixel in the last draw(), [0, 1].
    /// Waits for the GPU.
    [[nodiscard]] std::vector<float> readShown(Size output) const;

private:
    /// Extends region_ by the tiles with virtual surfaces, and `decides` by those of them in which
    /// real depth must be measured. `objects`: whether `tiles` belong to objects or to the shadow
    /// catcher.
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
    std::unique_ptr<TracedLayer> traced_;  // either traced_ or preview_ is null
    std::unique_ptr<OcclusionStep> occlusion_;
    CompositeOptions hiding_;
    double focal_, nearest_ = 0;  // focal_: focal length [px]; nearest_: largest inverse depth of
                                  // the objects [1/m]
    std::optional<RigidTransform> placedPose_, drawnPose_;
    PixelRect region_, drawn_;  // region_ [video px]; drawn_ [tiles]
    TextureLayer previewLayer_;
    LayerPicture* layer_ = nullptr;  // the layer that was drawn last
    int relied_ = 0;                 // number of consecutive frames in which known depth was used
    bool changed_ = false, hidden_ = false, shown_ = false;
};

}  // namespace mfar
