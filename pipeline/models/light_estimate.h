#pragma once

#include "pipeline/models/picture_radiance.h"
#include "pipeline/models/spherical_harmonics.h"
#include "pipeline/scene/scene.h"

#include <optional>
#include <vector>

namespace mfar {

/// The light at a place, as estimated from the camera.
struct LightEstimate {
    SphericalLight radiance;  ///< in world axes; 1 is the video's white
    /// Unit vector to where most light comes from, world: direction of the luminance's linear part.
    Eigen::Vector3f mainDirection{0, 0, 1};
    /// [0, 1]: 0 all directions are equally bright, 1 light from one direction only.
    float directionality = 0;
};

struct LightEstimatorOptions {
    /// [s], above 0: in this time, 1 - 1/e of a change of light is followed.
    double smoothingS = 3;
    /// [s], above 0: after this time, the weight of light out of view has fallen to 1/e.
    double memoryS = 120;
    float surfaceAlbedo = 0.5F;  ///< mean albedo of seen surfaces: how much brighter their light is
};

/// Estimates the surrounding light from the camera's pictures. Seen radiance is kept in a coarse
/// map of all directions, smoothed over time, so that a flash or a hand in front of the lens has
/// little effect. A camera mostly sees lit surfaces, seldom lamps. So the prior for unseen
/// directions is light from above that gives the seen surfaces their brightness. The nine
/// coefficients are a ridge regression of the map towards this prior, weighted by solid angle and
/// age. Lamps that the video clips are underestimated.
/// Source: Ramamoorthi, Hanrahan 2001 (nine coefficients); Sloan, Stupid Spherical Harmonics
/// Tricks, GDC 2008 (main direction).
class LightEstimator {
public:
    /// Throws std::invalid_argument for options out of range.
    explicit LightEstimator(const LightEstimatorOptions& options = {});

    /// Adds a video frame. Ignores a frame that is black, whose pose is not finite, or that is not
    /// newer than the last. Throws std::invalid_argument for an invalid view.
    void add(const ImageView& frame, const CameraModel& camera,
             const RigidTransform& T_world_camera, Timestamp time);

    /// Empty before the first frame.
    [[nodiscard]] std::optional<LightEstimate> estimate() const;

private:
    struct Seen {
        Eigen::Vector3f radiance{0, 0, 0};
        std::optional<Timestamp> last;
    };

    LightEstimatorOptions options_;
    std::optional<Timestamp> last_;
    std::vector<Seen> map_;            ///< in Environment's layout
    std::vector<SeenRadiance> frame_;  ///< radiance of the newest frame
};

/// Converts the estimate to a scene's lighting: a sun with soft shadows if one direction above the
/// horizon stands out, and the rest as a low-resolution environment.
[[nodiscard]] Lighting lightingOf(const LightEstimate& estimate);

}  // namespace mfar
