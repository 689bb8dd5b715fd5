#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/object_projection.h"
#include "pipeline/composite/pass_params.h"
#include "pipeline/composite/virtual_layer.h"
#include "pipeline/composite/virtual_object.h"

#include <array>
#include <span>

namespace mfar {

/// Lighting of the preview, in display values.
struct PreviewLight {
    Eigen::Vector3d towards{0.4, -0.3, 0.85};  ///< to the light, in the world, z up; any length
    double ambient = 0.35;                     ///< share of light from all directions, [0, 1]
};

/// The fast preview: rasterises virtual objects as the video camera would see them. The lens's
/// distortion is applied to vertices. Processes only the pixels where an object is or was. Needs an
/// OpenGL that can draw into R32F textures; otherwise the constructor throws GlError.
class PreviewRenderer {
public:
    /// `video`: the camera model at any resolution; the layer has size `output`.
    PreviewRenderer(const CameraModel& video, Size output, const PreviewLight& light = {});

    /// Solids are drawn from outside only, so a camera inside a solid does not see it. Objects
    /// behind the camera, outside the picture or without a finite pose are not drawn and cost no
    /// time.
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
