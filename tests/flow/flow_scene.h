#pragma once

#include "base/geometry.h"
#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <vector>

namespace mfar::test {

/// The plane normal . p = distance in the frame of the video camera, limited to points whose x and
/// y are between `least` and `greatest`. Its texture is a function of the point.
struct Surface {
    Eigen::Vector3d normal{0, 0, 1};
    double distance = 2;
    Eigen::Vector2d least{-1e9, -1e9}, greatest{1e9, 1e9};
};

/// A scene of plane, textured surfaces.
struct Scene {
    std::vector<Surface> surfaces;
    double grain = 20;     ///< cells of the finest texture per unit of length
    double contrast = 90;  ///< amplitude around 128 [grey levels]

    /// Depth z of the first surface on the ray of the pixel, for a camera at T_camera_video. Zero:
    /// the ray meets no surface.
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

/// Cameras of odd size, without and with distortion.
[[nodiscard]] CameraModel oddPlain();
[[nodiscard]] CameraModel oddBarrel();

/// A search for two cameras with equal lenses.
[[nodiscard]] EpipolarSearch searchWith(const CameraModel& camera, int threads);

/// The position in the still that a search finds for a pixel of the frame.
[[nodiscard]] Eigen::Vector2d landing(const EpipolarSearch& search, const View& view, int x, int y);

/// Errors of the flow that a search found [px], over the pixels that the still shows.
struct FlowErrors {
    std::size_t pixels = 0;
    double median = 0;
    double bad = 0;  ///< share of pixels with an error above one pixel
};
[[nodiscard]] FlowErrors errorsOf(const EpipolarSearch& search, const View& view);

/// True if all flow vectors of the search's result are finite.
[[nodiscard]] bool isFinite(const EpipolarSearch& search);

/// Rotates by the angles [degrees] about x, then y, then z. Then translates.
[[nodiscard]] RigidTransform motion(const Eigen::Vector3d& degrees, const Eigen::Vector3d& t);

}  // namespace mfar::test
