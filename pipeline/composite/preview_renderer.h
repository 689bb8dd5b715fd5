#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/pass_params.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/composite/virtual_object.h"

#include <array>
#include <span>

namespace mfar {

struct PreviewLight {
    /// Direction to the light in world coordinates (z up), of any length.
    Eigen::Vector3d towards{0.4, -0.3, 0.85};
    double ambient = 0.35;  ///< share of the light that comes from all directions, [0, 1]
};

/// Draws the fast preview: rasterises virtual objects as the video camera would see them. The lens
/// distortion is applied to the vertices. Only pixels in the bounds of the objects, in this and in
/// the last picture, are processed. The constructor throws GlError if OpenGL cannot draw into R32F
/// textures.
class PreviewRenderer {
public:
    /// `video` may have any resolution. The layer has the size `output`.
    PreviewRenderer(const CameraModel& video, Size output, const PreviewLight& light = {});

    /// Draws the objects as seen by a camera at this pose. Only the outside of closed shapes is
    /// drawn. Objects behind the camera, outside the picture or without a finite pose cause no work
    /// on the GPU.
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
