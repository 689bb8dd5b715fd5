#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar::test {

/// Spheres above the plane z = 0; z points up. Their colour is a function of the point. Each casts
/// a soft disc as its shadow. So casting rays gives the exact picture of any view.
struct CastScene {
    struct Ball {
        Eigen::Vector3d centre;
        double radius;
    };
    std::vector<Ball> balls;
    bool shadows = true;
    double contrast = 1;

    /// The scene as triangles, with `segments` segments around each sphere.
    [[nodiscard]] mfar::Scene scene(int segments = 192) const;
    /// Casts `grid`^2 rays per pixel for its colour, and one through its centre for depth and id.
    /// If the centre ray hits nothing, depth and id are those of the hit with the smallest z.
    [[nodiscard]] RenderedPicture cast(const RenderView& view, int grid = 1) const;
    /// Casts rays only for these pixels. All other pixels are empty.
    [[nodiscard]] RenderedPicture castPixels(const RenderView& view, int grid,
                                             std::span<const std::uint32_t> pixels) const;
};

[[nodiscard]] CastScene twoBalls();
[[nodiscard]] CameraModel bentCamera(Size size);
/// Pose of a camera at the azimuth `degrees` around the scene's centre. It looks at the centre from
/// `distance` [m] and `upDegrees` above the plane.
[[nodiscard]] RigidTransform orbit(double degrees, double distance = 0.6, double upDegrees = 30);

}  // namespace mfar::test
