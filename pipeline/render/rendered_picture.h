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

inline constexpr std::uint8_t kCatcherId = 255;

/// A finished picture of the virtual layer. Each array is row-major and has camera.size pixels.
struct RenderedPicture {
    CameraModel camera;  ///< the video camera with its lens, scaled to this picture's size
    RigidTransform T_world_camera;
    /// Display values (sRGB), premultiplied by coverage. The last byte is the coverage. A shadow is
    /// black with partial coverage.
    std::vector<std::array<std::uint8_t, 4>> colour;
    /// Depth [m], along the optical axis, of the first surface at the pixel's centre. A shadow
    /// catcher does not count there if no object changes its light. If there is no surface, it is
    /// the depth of the nearest object that a sample hit. If no sample hit an object, it is the
    /// depth of the nearest hit on the catcher. 0: the pixel is empty.
    std::vector<float> depth;
    std::vector<std::uint8_t> id;  ///< SceneObject's number or kCatcherId; 0: the pixel is empty
    /// Light on each pixel's object without the object's paint. Empty if the renderer does not
    /// provide it.
    std::vector<LightWords> light;
    /// How each pixel's object mirrors distant light: its normal, roughness and reflectance. Empty
    /// if the renderer does not provide it.
    std::vector<GlossWords> gloss;
    /// Distant light that the objects mirror, as radiance. Null if the renderer does not provide
    /// it.
    std::shared_ptr<const MirrorLight> mirrors;
    /// Factor from radiance to linear display values (white is 1). `light` already contains it,
    /// `mirrors` does not.
    float exposure = 1;
    /// True if each pixel shows only the surface at its centre, unmixed at edges. Such a picture
    /// must be warped before display.
    bool layered = false;
    std::shared_ptr<const Scene> scene;
    /// T_world_object of the scene's objects in this picture. Empty if none of them moves.
    std::vector<RigidTransform> poses;
    double samples = 0;  ///< mean number of samples per pixel with an id
};

}  // namespace mfar
