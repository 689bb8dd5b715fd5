#pragma once

#include "base/geometry.h"
#include "base/light_word.h"
#include "base/mirror_light.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// id of a pixel that shows a real surface on which virtual objects change the light.
inline constexpr std::uint8_t kCatcherId = 255;

/// A finished picture of the virtual layer. Row-major, camera.size pixels in each array.
struct RenderedPicture {
    CameraModel camera;  ///< of the video sensor, at the picture's resolution, with its lens
    RigidTransform T_world_camera;
    /// Display values (sRGB), premultiplied by coverage. A shadow is black of that coverage.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// z [m] along the camera's axis of the first surface through the pixel's centre, or of the
    /// nearest surface that a sample hit if the centre's ray hits none; 0: nothing.
    std::vector<float> depth;
    std::vector<std::uint8_t> id;  ///< owner of `depth`: SceneObject's number, 0: nothing
    /// Light on an object's pixels, without their paint; empty if the renderer does not provide it.
    std::vector<LightWords> light;
    /// How object pixels mirror the distant light `mirrors`, times `exposure`; empty if the
    /// renderer does not provide it.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    std::shared_ptr<const Scene> scene;  ///< the scene that it shows, if the renderer provides it
    double samples = 0;                  ///< mean over the pixels with an id
};

}  // namespace mfar
