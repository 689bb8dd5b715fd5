#pragma once

#include "base/gl/pass.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/silhouette_models.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// What of the virtual scene a camera sees now: the models and, below them, the real surface that
/// catches their shadows, rasterised at twice the layer's resolution, so that a pixel is covered by
/// quarters. The lens's distortion acts on the vertices. No light, no colours.
class ModelSilhouette {
public:
    /// `layer`: the camera at the layer's resolution. Throws GlError without R32UI targets.
    explicit ModelSilhouette(const CameraModel& layer);

    /// Uploads the meshes; of a scene of more than 20000 triangles simplified ones. Surfaces whose
    /// alpha is masked have their holes.
    void setScene(const Scene& scene);

    /// Layer pixels around all objects; of one that reaches before the near plane and beyond it,
    /// all of them.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const {
        return models_.bounds(T_world_camera);
    }

    /// Draws within `where` [layer px]; elsewhere there is nothing afterwards.
    void draw(const RigidTransform& T_world_camera, const PixelRect& where);

    [[nodiscard]] const SilhouetteModels& models() const { return models_; }
    /// R32UI, twice the layer's size: z and number, packed as warp_surface.glsl says; 0 = nothing.
    /// The catcher's number is seen only where no object is, nearer or not.
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }
    [[nodiscard]] std::size_t triangles() const { return models_.triangles(); }

private:
    using Models = SilhouetteModels;
    struct Part {
        gpu::Buffer vertices, indices;
        int indexCount;
        std::optional<gpu::Texture> alpha;  // of masked surfaces
        float cutoff;
        bool bothSides;  // are seen
    };
    using ShapePointer = std::shared_ptr<const Models::Shape>;
    using PartsOfShapes = std::map<ShapePointer, std::shared_ptr<std::vector<Part>>>;

    static Part partOf(const Models::Part& part);
    void addParts(const ShapePointer& shape, const PartsOfShapes& before);
    void clear(const PixelRect& where) const;
    void drawObject(const Models::Object& object, std::size_t number,
                    const RigidTransform& T_camera_world);

    LensProjection lens_;
    Models models_;
    PartsOfShapes parts_;
    PixelRect drawn_;
    gpu::Texture surface_, window_;
    gpu::Framebuffer target_;
    gpu::DrawPass<params::SilhouetteMesh> pass_, maskedPass_;
};

}  // namespace mfar
