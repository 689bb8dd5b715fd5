#pragma once

#include "pipeline/models/picture_radiance.h"
#include "pipeline/models/spherical_harmonics.h"
#include "pipeline/scene/scene.h"

#include <optional>
#include <vector>

namespace mfar {

/// The light of a place as far as a camera could tell.
struct LightEstimate {
    SphericalLight radiance;  ///< world; 1 is the video's white
    /// World, unit length, where most light comes from: of the linear part of the luminance.
    Eigen::Vector3f mainDirection{0, 0, 1};
    float directionality = 0;  ///< [0, 1]: 0 no direction is brighter, 1 one alone
};

struct LightEstimatorOptions {
    double smoothingS = 3;  ///< a change of light is followed to 1 - 1/e in this time, above 0 [s]
    double memoryS = 120;   ///< what is out of view counts 1/e after this time, above 0 [s]
    float surfaceAlbedo = 0.5F;  ///< of what is seen, in the mean: how much brighter its light is
};

/// Estimates the light around from where a camera looks. Seen radiance is kept in a coarse map of
/// all directions, smoothed over time, so that a flash or a hand in front of the lens moves it
/// little. A camera mostly sees surfaces that are lit, seldom lamps: what was not seen is taken for
/// the light that makes the seen surfaces as bright as they are, from above (prior), and the nine
/// coefficients are the ridge regression of the map, weighted by solid angle and age, towards that
/// prior. Lamps that the video clips are too dim.
/// Source: Ramamoorthi, Hanrahan 2001 (nine coefficients); Sloan, Stupid Spherical Harmonics
/// Tricks, GDC 2008 (main direction).
class LightEstimator {
public:
    /// Throws std::invalid_argument for options out of range.
    explicit LightEstimator(const LightEstimatorOptions& options = {});

    /// Takes a video frame. One that is black, whose pose is not finite, or that is not newer than
    /// the last is left out. Throws std::invalid_argument for a view that is not sound.
    void add(const ImageView& frame, const CameraModel& camera,
             const RigidTransform& T_world_camera, Timestamp time);

    /// Nothing before the first frame.
    [[nodiscard]] std::optional<LightEstimate> estimate() const;

private:
    struct Seen {
        Eigen::Vector3f radiance{0, 0, 0};
        std::optional<Timestamp> last;
    };

    LightEstimatorOptions options_;
    std::optional<Timestamp> last_;
    std::vector<Seen> map_;            ///< as an Environment
    std::vector<SeenRadiance> frame_;  ///< of the newest frame
};

/// The estimate as light of a scene: where one direction stands out and is above the horizon, a sun
/// there with soft shadows, and the rest as a low-resolution environment.
[[nodiscard]] Lighting lightingOf(const LightEstimate& estimate);

}  // namespace mfar
