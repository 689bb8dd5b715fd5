#pragma once

#include "pipeline/models/picture_radiance.h"
#include "pipeline/models/spherical_harmonics.h"
#include "pipeline/scene/scene.h"

#include <optional>
#include <vector>

namespace mfar {

/// The light around the scene, estimated from the camera's pictures.
struct LightEstimate {
    SphericalLight radiance;  ///< radiance in world coordinates; a radiance of 1 is the video's
                              ///< white
    /// Unit vector in the world towards the direction from which most light comes: the direction of
    /// the linear part of the luminance.
    Eigen::Vector3f mainDirection{0, 0, 1};
    /// 0: all directions are equally bright; 1: all light comes from one direction.
    float directionality = 0;
};

struct LightEstimatorOptions {
    /// Time constant [s] with which the estimate follows changes of the light (1 - 1/e of a change
    /// after this time); above 0.
    double smoothingS = 3;
    /// Time constant [s] with which the weight of light from directions that are out of view
    /// decreases (to 1/e after this time); above 0.
    double memoryS = 120;
    float surfaceAlbedo = 0.5F;  ///< mean albedo of the surfaces that the camera sees
};

/// Estimates the light around the scene from the camera's pictures.
/// The radiance that the camera sees is stored in a coarse map of all directions. It is smoothed
/// over time, so that a flash or a hand in front of the lens has little effect. A camera mostly
/// sees lit surfaces and rarely lamps. The prior for directions that were not seen is therefore
/// light from above that gives the seen surfaces their brightness. The nine coefficients of the
/// light are fitted to the map by ridge regression towards this prior, weighted by solid angle and
/// age. Lamps that are clipped in the video are underestimated.
/// Sources: Ramamoorthi, Hanrahan 2001 (nine coefficients); Sloan, Stupid Spherical Harmonics
/// Tricks, GDC 2008 (main direction).
class LightEstimator {
public:
    /// Throws std::invalid_argument if an option is out of range.
    explicit LightEstimator(const LightEstimatorOptions& options = {});

    /// Adds a video frame. Ignores a frame that is black, has a pose that is not finite, or is not
    /// newer than the last frame. Throws std::invalid_argument if the view is invalid.
    void add(const ImageView& frame, const CameraModel& camera,
             const RigidTransform& T_world_camera, Timestamp time);

    /// Returns the present estimate. Empty before the first frame.
    [[nodiscard]] std::optional<LightEstimate> estimate() const;

private:
    struct Seen {
        Eigen::Vector3f radiance{0, 0, 0};
        std::optional<Timestamp> last;
    };

    LightEstimatorOptions options_;
    std::optional<Timestamp> last_;
    std::vector<Seen> map_;            ///< seen light of all directions, with the layout of
                                       ///< Environment
    std::vector<SeenRadiance> frame_;  ///< radiance seen in the newest frame
};

/// Converts the estimate to a scene's lighting. If much more light comes from one direction above
/// the horizon than from others, this light becomes a sun with soft shadows. The rest becomes an
/// environment of low resolution.
[[nodiscard]] Lighting lightingOf(const LightEstimate& estimate);

}  // namespace mfar
