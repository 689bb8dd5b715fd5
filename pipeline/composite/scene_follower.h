#pragma once

#include "base/geometry.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// Decides when the shadow catcher (the invisible surface that receives the shadows of virtual
/// objects) is measured. At first, the catcher consists of the plane of the tag map and of the
/// planes of other tags on which objects stand. After `settling` - 1 frames with objects in view, a
/// measured surface replaces these planes as soon as depth is known at a share of at least
/// `leastKnown` of the pixels in the rectangle around the objects. Outside of the view, the planes
/// stay. The surface is measured again if depth is known at the same share of pixels, at least
/// `leastInterval` [s] have passed, and the camera has moved around the objects by at least the
/// angle `turn` [rad].
struct CatcherRule {
    int settling = 12;
    double leastKnown = 0.7;
    double turn = 0.35;
    double leastInterval = 4;
};

/// Gives a scene its shadow catcher. Shadows of virtual objects fall onto the planes of tags at
/// first, later onto the measured surface of the real scene.
class SceneFollower {
public:
    explicit SceneFollower(const CatcherRule& rule = {}) : rule_(rule) {}

    /// Replaces the scene. Its shadow catcher consists of the planes of tags until the surface is
    /// measured again. Returns the scene that must be shown.
    std::shared_ptr<const Scene> set(Scene scene);

    /// Changes the light. Returns the scene with the new light, which must be shown.
    std::shared_ptr<const Scene> relight(Lighting lighting);

    /// The depth of the real scene in a frame. `field` is known only inside the rectangle `where`
    /// [video px], the camera is at the pose `T_world_video`.
    struct RealDepth {
        const InverseDepthField& field;
        const PixelRect& where;
        const CameraModel& video;
        const RigidTransform& T_world_video;
        Timestamp time;
    };
    /// Must be called after each frame. `region` is the rectangle around the objects [video px].
    /// The surface is measured only if `depth.where` contains the part of `region` inside the
    /// picture. Returns the scene that must be shown if the shadow catcher has changed, otherwise
    /// null.
    std::shared_ptr<const Scene> follow(const RealDepth& depth, const PixelRect& region);

private:
    [[nodiscard]] bool isDue(const RigidTransform& T_world_video, Timestamp time) const;

    CatcherRule rule_;
    Scene scene_;
    // The result of groundPlanes(). The first plane is that of the tag map; its bounds contain all
    // objects.
    std::vector<GroundPlane> planes_;
    int frames_ = 0;
    std::optional<Timestamp> caught_;
    Eigen::Vector3d caughtFrom_{0, 0, 0};
};

}  // namespace mfar
