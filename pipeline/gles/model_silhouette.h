#pragma once

#include "base/gl/pass.h"
#include "pipeline/gles/paint_textures.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/silhouette_models.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// Draws the depth, number and paint of the virtual surface that is visible at each pixel: an
/// object or, where there is none, the shadow catcher. A planar shadow catcher is not drawn.
/// Surfaces are rasterised at twice the layer's resolution, so that each layer pixel has four
/// quarters. The lens distortion is applied to the vertices. Light is not computed.
class ModelSilhouette {
public:
    /// `layer` is the video camera at the layer's resolution. Throws GlError if the GL
    /// implementation cannot draw into R32UI.
    explicit ModelSilhouette(const CameraModel& layer);

    /// Uploads the scene's meshes. If the scene has more than 20000 triangles, the meshes are
    /// simplified. Surfaces with an alpha mask are not drawn where their alpha is below the mask's
    /// threshold.
    void setScene(const Scene& scene);
    void setPoses(std::span<const RigidTransform> T_world_objects) {
        models_.setPoses(T_world_objects);
    }

    /// Bounds of all objects [layer px], or of the whole layer if an object crosses the near plane.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const {
        return models_.bounds(T_world_camera);
    }

    /// Draws the surfaces that a camera at this pose sees in `where` [layer px]. The rest of
    /// surface() is empty.
    void draw(const RigidTransform& T_world_camera, const PixelRect& where);

    [[nodiscard]] const SilhouetteModels& models() const { return models_; }
    /// R32UI with twice the layer's size: z and number of the surface, packed as in
    /// warp_surface.glsl, or 0 without a surface. Objects hide the shadow catcher, even if the
    /// catcher is nearer.
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }
    /// sRGB textures of surface()'s size with the paint of objects (see PaintWords). Valid only
    /// where surface() shows an object.
    [[nodiscard]] const gpu::Texture& diffuse() const { return diffuse_; }
    [[nodiscard]] const gpu::Texture& facing() const { return facing_; }
    [[nodiscard]] std::size_t triangles() const { return models_.triangles(); }

private:
    using Models = SilhouetteModels;
    struct Part {
        gpu::Buffer vertices, indices;
        int indexCount;
        std::shared_ptr<const gles::PaintTextures> paint;
        std::optional<gpu::Texture> alpha;
        float cutoff;
        bool bothSides;
    };
    using ShapePointer = std::shared_ptr<const Models::Shape>;
    using PartsOfShapes = std::map<ShapePointer, std::shared_ptr<std::vector<Part>>>;

    Part partOf(const Models::Part& part);
    void addParts(const ShapePointer& shape, const PartsOfShapes& before);
    void clear(const PixelRect& where) const;
    void drawObject(const Models::Object& object, std::size_t number,
                    const RigidTransform& T_camera_world);

    LensProjection lens_;
    Models models_;
    PartsOfShapes parts_;
    gles::PaintStore paints_;
    PixelRect drawn_;
    gpu::Texture surface_, diffuse_, facing_, window_;
    gpu::Framebuffer target_;
    gpu::DrawPass<params::SilhouetteMesh> pass_, maskedPass_;
};

}  // namespace mfar
