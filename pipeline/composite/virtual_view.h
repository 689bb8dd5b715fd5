#pragma once

#include "pipeline/composite/composite.h"
#include "pipeline/composite/preview_renderer.h"
#include "pipeline/composite/silhouette.h"
#include "pipeline/depth/inverse_depth_field.h"

#include <optional>
#include <vector>

namespace mfar {

/// Virtual objects in the picture of the real scene: where real depth decides about them, and their
/// drawing over the picture.
class VirtualView {
public:
    VirtualView(const CameraModel& video, Size output);

    /// Shown from the next place() on.
    void setObjects(std::vector<VirtualObject> objects);

    /// Where the objects are for a camera at this pose; nothing: they are not shown. Gives the
    /// video pixels whose real depth decides what of them is seen, empty where none is in the
    /// picture.
    const PixelRect& place(const std::optional<RigidTransform>& T_world_video);
    /// The last picture shows what this one must not, although nothing else may have changed: other
    /// objects, or any after none and the other way round.
    [[nodiscard]] bool mustRedraw() const;
    /// Tiles of the picture to draw anew before the next draw().
    [[nodiscard]] PixelRect staleTiles() const;

    /// Draws them, as placed, over `picture`, which `target` draws into.
    void draw(const InverseDepthField& real, const gpu::Texture& video, const gpu::Texture& picture,
              const gpu::Framebuffer& target);

    /// Share of every output pixel that shows a virtual object, as last drawn. Waits for the GPU.
    [[nodiscard]] std::vector<float> readShown() const;

private:
    void upload(const InverseDepthField& real);

    Size video_;
    std::vector<VirtualObject> objects_;
    Silhouette silhouette_;
    PreviewRenderer renderer_;
    Composite composite_;
    gpu::Texture depth_;
    std::vector<float> values_;
    std::optional<RigidTransform> placedPose_;
    PixelRect region_, drawn_;  // video pixels, tiles
    VirtualLayer layer_;        // as last drawn
    bool changed_ = false, placed_ = false;
};

}  // namespace mfar
