#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <vector>

namespace mfar::test {

/// A part of a plane in the video camera's coordinates: the points p with `normal` . p = `distance`
/// whose x and y are between `least` and `greatest`. The texture is a function of p.
struct Surface {
    Eigen::Vector3d normal{0, 0, 1};
    double distance = 2;
    Eigen::Vector2d least{-1e9, -1e9}, greatest{1e9, 1e9};
};

struct Scene {
    std::vector<Surface> surfaces;
    double grain = 20;     ///< lattice points of the finest texture per unit of length
    double contrast = 90;  ///< grey levels differ from 128 by up to 1.2 times this

    /// Depth z of the first surface on a pixel's ray, for a camera at T_camera_video. 0 if the ray
    /// meets no surface.
    [[nodiscard]] double depth(const RigidTransform& T_camera_video,
                               const Eigen::Vector2d& ray) const;
    [[nodiscard]] LumaImage render(const CameraModel& camera,
                                   const RigidTransform& T_camera_video) const;
};

struct View {
    CameraModel camera;
    Scene scene;
    RigidTransform T_still_video;

    [[nodiscard]] LumaImage video() const { return scene.render(camera, {}); }
    [[nodiscard]] LumaImage still() const { return scene.render(camera, T_still_video); }
};

using mfar::viewOf;

[[nodiscard]] CameraModel oddPlain();
[[nodiscard]] CameraModel oddBarrel();

[[nodiscard]] EpipolarSearch searchWith(const CameraModel& camera, int threads);

/// Position in the still at which `search` found pixel (x, y) of the frame.
[[nodiscard]] Eigen::Vector2d landing(const EpipolarSearch& search, const View& view, int x, int y);

/// Errors of the flow that a search found, over the pixels that are visible in the still: the
/// median [px], and the share `bad` of pixels with an error above 1 px.
struct FlowErrors {
    std::size_t pixels = 0;
    double median = 0;
    double bad = 0;
};
[[nodiscard]] FlowErrors errorsOf(const EpipolarSearch& search, const View& view);

[[nodiscard]] bool isFinite(const EpipolarSearch& search);

/// Rotates by the angles [degrees] about x, then y, then z. Then translates.
[[nodiscard]] RigidTransform motion(const Eigen::Vector3d& degrees, const Eigen::Vector3d& t);

}  // namespace mfar::test
