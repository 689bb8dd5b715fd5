#pragma once

#include "base/geometry.h"

namespace mfar {

/// The view from which a picture of the scene is taken.
struct RenderView {
    CameraModel camera;  ///< with its lens; size at least 1x1
    RigidTransform T_world_camera;
};

}  // namespace mfar
