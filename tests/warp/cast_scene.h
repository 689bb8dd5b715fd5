#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"
#include "pipeline/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar::test {

/// Spheres over the plane z = 0, each patterned by a function of the point alone and shadowed on
/// the plane by a soft disc: known from anywhere exactly, by casting rays. World frame: z up.
struct CastScene {
    struct Ball {
        Eigen::Vector3d centre;
        double radius;
    };
    std::vector<Ball> balls;
    bool shadows = true;
    double contrast = 1;  ///< of the balls' pattern

    /// The same as triangles, round to `segments` around.
    [[nodiscard]] mfar::Scene scene(int segments = 192) const;
    /// `grid`^2 rays a pixel for the colour, one through its centre for depth and number.
    [[nodiscard]] RenderedPicture cast(const RenderView& view, int grid = 1) const;
    /// Of these pixels alone; the others are empty.
    [[nodiscard]] RenderedPicture castPixels(const RenderView& view, int grid,
                                             std::span<const std::uint32_t> pixels) const;
};

/// A big ball, a small one before it, their shadows.
[[nodiscard]] CastScene twoBalls();
/// A lens with some distortion, off centre.
[[nodiscard]] CameraModel bentCamera(Size size);
/// The camera at `degrees` around the scene's middle, looking at it from 0.6 m; `up` above the
/// plane.
[[nodiscard]] RigidTransform orbit(double degrees, double distance = 0.6, double upDegrees = 30);

}  // namespace mfar::test
