#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <vector>

namespace mfar::test {

/// The plane normal . p = distance in the video's frame, limited to points with x and y between
/// `least` and `greatest`. Its texture is a function of space.
struct Surface {
    Eigen::Vector3d normal{0, 0, 1};
    double distance = 2;
    Eigen::Vector2d least{-1e9, -1e9}, greatest{1e9, 1e9};
};

/// A scene for a camera that sees surfaces of unit size with about `grain` cells of texture.
struct Scene {
    std::vector<Surface> surfaces;
    double grain = 20;     ///< cells of the finest texture per unit of length
    double contrast = 90;  ///< grey levels above and below 128

    /// Depth z of the first surface on the pixel's ray, seen from T_camera_video; zero: no surface.
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

/// Of an odd size, without and with distortion.
[[nodiscard]] CameraModel oddPlain();
[[nodiscard]] CameraModel oddBarrel();

/// A search in which both cameras are the same.
[[nodiscard]] EpipolarSearch searchWith(const CameraModel& camera, int threads);

/// The place of the frame's pixel in the still, according to a search.
[[nodiscard]] Eigen::Vector2d landing(const EpipolarSearch& search, const View& view, int x, int y);

/// Errors of a search's flow [px], over the pixels that are visible in the still.
struct FlowErrors {
    std::size_t pixels = 0;
    double median = 0;
    double bad = 0;  ///< share of pixels with an error of more than one pixel
};
[[nodiscard]] FlowErrors errorsOf(const EpipolarSearch& search, const View& view);

/// True when the whole field is finite.
[[nodiscard]] bool isFinite(const EpipolarSearch& search);

/// Rotates by the angles [degrees] about x, then y, then z, then translates.
[[nodiscard]] RigidTransform motion(const Eigen::Vector3d& degrees, const Eigen::Vector3d& t);

}  // namespace mfar::test
