#pragma once

#include "base/geometry.h"
#include "base/light_word.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Number of a pixel that shows a real surface on which virtual things change the light.
inline constexpr std::uint8_t kCatcherId = 255;

/// A finished picture of the virtual layer. Row-major, camera.size pixels each.
struct RenderedPicture {
    CameraModel camera;  ///< of the video sensor, at the picture's resolution, with its lens
    RigidTransform T_world_camera;
    /// Display values (sRGB), premultiplied by coverage. A shadow is black of that coverage.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// z [m] along the camera's axis of the first surface through the pixel's centre, or of the
    /// nearest one any sample hit where that goes by; 0 = nothing.
    std::vector<float> depth;
    std::vector<std::uint8_t> id;  ///< what `depth` belongs to: SceneObject's number, 0 = nothing
    /// Of an object's pixels, without their paint; empty where their maker does not tell.
    std::vector<LightWords> light;
    std::shared_ptr<const Scene> scene;  ///< what it is a picture of, where its maker says so
    double samples = 0;                  ///< in the mean over the pixels with an id
};

}  // namespace mfar
