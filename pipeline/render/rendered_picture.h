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

/// id of a pixel that shows the shadow catcher: a real surface whose light virtual objects change.
inline constexpr std::uint8_t kCatcherId = 255;

/// A finished picture of the virtual layer. Each array is row-major and has camera.size pixels.
struct RenderedPicture {
    CameraModel camera;  ///< of the video sensor with its lens, scaled to this picture's size
    RigidTransform T_world_camera;
    /// Display values (sRGB), premultiplied by coverage. The last byte is the coverage. A shadow is
    /// black with partial coverage.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// z [m] along the camera's optical axis of the first surface on the ray through the pixel's
    /// centre. If that ray hits nothing, z of the nearest surface that a sample hit; 0: no surface.
    std::vector<float> depth;
    std::vector<std::uint8_t> id;  ///< surface at `depth`: SceneObject's number, kCatcherId, or 0
    /// Light on the object in each pixel, without the object's paint. Empty if the renderer does
    /// not provide it.
    std::vector<LightWords> light;
    /// How the object in each pixel mirrors distant light, which is `mirrors` times `exposure`.
    /// Empty if the renderer does not provide it.
    std::vector<GlossWords> gloss;
    std::shared_ptr<const MirrorLight> mirrors;
    float exposure = 1;
    /// Whether each pixel shows only the surface at its centre, without the mixture at edges. Such
    /// a picture must be warped.
    bool layered = false;
    std::shared_ptr<const Scene> scene;  ///< the scene in this picture; may be null
    double samples = 0;                  ///< samples per pixel, averaged over the pixels with an id
};

}  // namespace mfar
