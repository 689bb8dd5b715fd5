#pragma once

#include "base/geometry.h"

namespace mfar {

struct RenderView {
    CameraModel camera;
    RigidTransform T_world_camera;
};

}  // namespace mfar
