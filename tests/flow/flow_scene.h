#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <vector>

namespace mfar::test {

/// The plane normal . p = distance of the video's coordinates, where `within` holds: x and y of
/// its points between these. It carries a texture that fills space.
struct Surface {
    Eigen::Vector3d normal{0, 0, 1};
    double distance = 2;
    Eigen::Vector2d least{-1e9, -1e9}, greatest{1e9, 1e9};
};

/// Surfaces of unit size as a camera with about `grain` units of texture a unit of length sees it.
struct Scene {
    std::vector<Surface> surfaces;
    double grain = 20;     ///< cells of the finest texture a unit of length
    double contrast = 90;  ///< grey levels either side of 128

    /// Depth z of what the pixel's ray hits first, seen from T_camera_video; zero: nothing.
    [[nodiscard]] double depth(const RigidTransform& T_camera_video,
                               const Eigen::Vector2d& ray) const;
    [[nodiscard]] LumaImage render(const CameraModel& camera,
                                   const RigidTransform& T_camera_video) const;
};

/// A frame and a still of a scene, with the pose between them.
struct View {
    CameraModel camera;
    Scene scene;
    RigidTransform T_still_video;

    [[nodiscard]] LumaImage video() const { return scene.render(camera, {}); }
    [[nodiscard]] LumaImage still() const { return scene.render(camera, T_still_video); }
};

using mfar::viewOf;

/// Of an odd size, without and with a lens that bends.
[[nodiscard]] CameraModel oddPlain();
[[nodiscard]] CameraModel oddBarrel();

/// A search whose two cameras are the same.
[[nodiscard]] EpipolarSearch searchWith(const CameraModel& camera, int threads);

/// Where a search says that the frame's pixel lies in the still.
[[nodiscard]] Eigen::Vector2d landing(const EpipolarSearch& search, const View& view, int x, int y);

/// Errors of a search's flow over pixels that the still shows, not hidden there [px].
struct FlowErrors {
    std::size_t pixels = 0;
    double median = 0;
    double bad = 0;  ///< share of pixels more than one pixel off
};
[[nodiscard]] FlowErrors errorsOf(const EpipolarSearch& search, const View& view);

/// All of the field is finite.
[[nodiscard]] bool isFinite(const EpipolarSearch& search);

/// Rotations [degrees] about x, then y, then z; translation of points.
[[nodiscard]] RigidTransform motion(const Eigen::Vector3d& degrees, const Eigen::Vector3d& t);

}  // namespace mfar::test
