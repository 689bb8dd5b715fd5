#pragma once

#include "base/geometry.h"

namespace mfar {

/// The camera and its pose for one picture of the scene.
struct RenderView {
    CameraModel camera;  ///< includes the lens; size at least 1x1
    RigidTransform T_world_camera;
};

}  // namespace mfar
