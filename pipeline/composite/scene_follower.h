#pragma once

#include "base/geometry.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>

namespace mfar {

/// Decides when the shadow catcher is measured again.
struct CatcherRule {
    int settling = 12;         ///< number of frames after which a measured surface may replace the
                               ///< plane
    double leastKnown = 0.7;   ///< smallest share of pixels around the objects whose depth must be
                               ///< known
    double turn = 0.35;        ///< angle by which the camera must have moved around the objects
                               ///< [rad]
    double leastInterval = 4;  ///< shortest time between two measurements [s]
};

/// Keeps the scene's shadow catcher up to date with the real scene. At first, shadows of virtual
/// objects fall onto the plane of the tag map; later, they fall onto the measured surface.
class SceneFollower {
public:
    explicit SceneFollower(const CatcherRule& rule = {}) : rule_(rule) {}

    /// Replaces the scene. The shadow catcher is the plane of the tag map again. Returns the scene
    /// that is to be shown.
    std::shared_ptr<const Scene> set(Scene scene);

    /// Changes the light. Returns the scene that is to be shown.
    std::shared_ptr<const Scene> relight(Lighting lighting);

    /// Must be called after each frame. `field`: depth of the real scene, measured in the rectangle
    /// `region` [video px] around the objects. If the shadow catcher has changed, returns the scene
    /// that is to be shown, otherwise null.
    std::shared_ptr<const Scene> follow(const InverseDepthField& field, const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const PixelRect& region, Timestamp time);

private:
    [[nodiscard]] bool isDue(const RigidTransform& T_world_video, Timestamp time) const;

    CatcherRule rule_;
    Scene scene_;
    Eigen::AlignedBox3d objects_;
    int frames_ = 0;
    std::optional<Timestamp> caught_;  // time of the frame from which the shadow catcher was last
                                       // measured
    Eigen::Vector3d caughtFrom_{0, 0, 0};
};

}  // namespace mfar
