#pragma once

#include "pipeline/models/picture_radiance.h"
#include "pipeline/models/spherical_harmonics.h"
#include "pipeline/scene/scene.h"

#include <optional>
#include <vector>

namespace mfar {

struct LightEstimate {
    SphericalLight radiance;  ///< in world coordinates; 1 is the video's white
    /// Unit vector in the world towards the most light, from the luminance's spherical harmonics of
    /// degree 1.
    Eigen::Vector3f mainDirection{0, 0, 1};
    /// 0 if all directions are equally bright, 1 if all light comes from one direction.
    float directionality = 0;
};

struct LightEstimatorOptions {
    /// Time constant of the smoothing [s], above 0. After this time, the estimate shows 1 - 1/e of
    /// a change.
    double smoothingS = 3;
    /// Time constant for light from directions that are out of view [s], above 0. After this time,
    /// its weight is 1/e.
    double memoryS = 120;
    float surfaceAlbedo = 0.5F;  ///< assumed albedo of the surfaces that the camera sees, (0, 1]
};

/// Estimates the light around the scene from the camera's pictures. The radiance in the pictures is
/// collected in a coarse map of all directions and smoothed over time, so that a flash or a hand in
/// front of the lens has little effect. Nine coefficients of spherical harmonics are fitted to the
/// map by ridge regression, weighted by solid angle and age.
///
/// A camera mostly sees lit surfaces and rarely lamps. Unless the pictures show otherwise, the
/// light is therefore assumed to come from above, and to be as strong as the brightness of the seen
/// surfaces requires. Lamps that are clipped in the video are underestimated. Sources: Ramamoorthi,
/// Hanrahan 2001 (nine coefficients); Sloan, Stupid Spherical Harmonics Tricks, GDC 2008 (main
/// direction).
class LightEstimator {
public:
    /// Throws std::invalid_argument if an option is out of range.
    explicit LightEstimator(const LightEstimatorOptions& options = {});

    /// Adds a video frame. Ignores a frame that is black, has a pose that is not finite, or is not
    /// newer than the last added frame. Returns false if the frame was ignored. Throws
    /// std::invalid_argument if `frame` is invalid (requireSound()).
    bool add(const ImageView& frame, const CameraModel& camera,
             const RigidTransform& T_world_camera, Timestamp time);

    /// Empty until the first frame was added.
    [[nodiscard]] std::optional<LightEstimate> estimate() const;

private:
    struct Seen {
        Eigen::Vector3f radiance{0, 0, 0};
        std::optional<Timestamp> last;
    };

    LightEstimatorOptions options_;
    std::optional<Timestamp> last_;
    std::vector<Seen> map_;
    std::vector<SeenRadiance> frame_;
};

/// Converts the estimate to a scene's lighting. If one direction above the horizon is much brighter
/// than the others, a part of the light becomes a sun with soft shadows. The rest becomes an
/// environment of low resolution.
[[nodiscard]] Lighting lightingOf(const LightEstimate& estimate);

}  // namespace mfar
