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

/// Shows virtual objects in the picture of the real scene. Determines where real depth must be
/// measured to decide which parts of the objects are visible, and draws the objects over the
/// picture.
class VirtualView {
public:
    /// Creates a view whose objects PreviewRenderer draws. `engine` must outlive this object.
    VirtualView(const CameraModel& video, Size output, Engine& engine);
    /// Creates a view whose objects the path tracer draws. `engine` must outlive this object.
    /// Throws the same exceptions as TracedLayer.
    VirtualView(const CameraModel& video, Engine& engine, TracedLayerOptions options);

    void setObjects(std::vector<VirtualObject> objects);
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    /// Sets the scene of a view whose objects the path tracer draws. The scene becomes visible when
    /// its first traced picture is finished.
    void setScene(std::shared_ptr<const Scene> scene);
    [[nodiscard]] TracedLayer* traced() { return traced_.get(); }

    /// Places the objects for a camera at this pose. Without a pose, no object is shown. `known` is
    /// the approximate depth of the real scene as the camera sees it. Returns the rectangle of the
    /// video pixels whose real depth must be measured to find which parts of the objects are
    /// visible. The rectangle is empty if neither an object nor a surface that may be shaded is in
    /// the picture. It is also empty in up to 8 frames in a row (kMostRelied) if `known` shows that
    /// the real scene lies behind all objects.
    PixelRect place(const std::optional<RigidTransform>& T_world_video, Timestamp time,
                    const InverseDepthField& known);
    [[nodiscard]] const PixelRect& region() const { return region_; }
    /// True if the real scene completely hides all placed objects and all places where they may
    /// cast shadows or light.
    [[nodiscard]] bool isHidden() const { return hidden_; }
    /// Returns which changes of the video require that the objects are drawn again. Always: they
    /// are drawn even if the video did not change, because objects changed, appeared, disappeared
    /// or move, because the traced picture changes, or because SkipOptions::objectsAtRest is off.
    /// WithOthers: they are drawn if any tile changed, because the camera has moved. WithThem: they
    /// are drawn only if a tile near them changed.
    [[nodiscard]] WorkPlan::Redraw redraw() const;
    /// Tiles of the video that must be drawn again before draw().
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws the placed objects over the picture. `real` is the depth of the real scene. It is
    /// unknown outside `where`.
    void draw(const InverseDepthField& real, const PixelRect& where, const VideoFrame& frame,
              Field<std::uint32_t>& picture);

    /// Returns how much the virtual objects cover each output pixel after the last draw(), [0, 1].
    /// Waits for the GPU.
    [[nodiscard]] std::vector<float> readShown(Size output) const;

private:
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
    double focal_, nearest_ = 0;  // nearest_: largest inverse depth of the objects [1/m]
    std::optional<RigidTransform> placedPose_, drawnPose_;
    PixelRect region_, drawn_;  // region_ in video pixels, drawn_ in tiles
    TextureLayer previewLayer_;
    LayerPicture* layer_ = nullptr;
    int relied_ = 0;
    bool changed_ = false, hidden_ = false, shown_ = false;
};

}  // namespace mfar
