#pragma once

#include "base/light_word.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Pixels to render individually, because older pictures do not show them or show them blurred.
struct HoleRequest {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< row-major indices, in any order
    int samples = 4;                    ///< samples per pixel
    std::uint64_t scene = 0;            ///< number chosen by the caller, copied to the answer
    bool edges = false;                 ///< true: older pictures show these pixels blurred
    /// Scene of the picture that has the holes. The request is dropped if pictures of another scene
    /// have replaced that picture. Null: the scene of the newest pictures.
    std::shared_ptr<const Scene> source{};
};

/// The answer to a HoleRequest. Colours, depths, ids and light have one value for each entry of
/// `pixels`, defined as in RenderedPicture.
struct HoleAnswer {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< in ascending order
    std::vector<std::array<std::uint8_t, 4>> colour;
    std::vector<float> depth;
    std::vector<std::uint8_t> id;
    std::vector<LightWords> light;
    int samples = 0;          ///< samples per pixel
    std::uint64_t scene = 0;  ///< copied from the request
    bool edges = false;       ///< copied from the request
};

}  // namespace mfar
