#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/pass_params.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/composite/virtual_object.h"

#include <array>
#include <span>

namespace mfar {

/// Lighting of the preview.
struct PreviewLight {
    Eigen::Vector3d towards{0.4, -0.3, 0.85};  ///< direction to the light in the world (z up), of
                                               ///< any length
    double ambient = 0.35;                     ///< share of light from all directions, [0, 1]
};

/// Draws the fast preview: rasterises virtual objects as the video camera would see them. The lens
/// distortion is applied to the vertices. Only pixels that an object covers, or covered in the last
/// picture, are processed. OpenGL must be able to draw into R32F textures; otherwise the
/// constructor throws GlError.
class PreviewRenderer {
public:
    /// `video`: the camera model at any resolution; the layer has size `output`.
    PreviewRenderer(const CameraModel& video, Size output, const PreviewLight& light = {});

    /// Draws the objects as a camera at this pose sees them. Only the outside of solids is drawn,
    /// so a camera inside a solid does not see it. Objects behind the camera, outside the picture
    /// or without a finite pose are not drawn and cost no time.
    const VirtualLayer& render(std::span<const VirtualObject> objects,
                               const RigidTransform& T_world_video);

private:
    struct ShapeBuffers {
        gpu::Buffer vertices, indices;
        int indexCount;
    };

    static ShapeBuffers buffersOf(const ShapeMesh& mesh);
    [[nodiscard]] params::PreviewObject paramsOf(const VirtualObject& object,
                                                 const RigidTransform& T_world_video) const;
    /// Bounds of the pixels that the object covers.
    [[nodiscard]] PixelRect boundsOf(const VirtualObject& object,
                                     const RigidTransform& T_world_video);
    void clear(const PixelRect& pixels) const;

    ObjectProjection projection_;
    PreviewLight light_;
    std::array<ShapeBuffers, kVirtualShapes> shapes_;
    gpu::Texture colour_, depth_, window_;
    gpu::Framebuffer target_;
    gpu::DrawPass<params::PreviewObject> pass_;
    VirtualLayer layer_;
};

}  // namespace mfar
