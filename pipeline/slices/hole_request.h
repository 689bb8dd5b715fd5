#pragma once

#include "base/light_word.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Pixels of a view that no older picture shows, or shows blurred; they are to be rendered
/// individually.
struct HoleRequest {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< row-major indices, in any order
    int samples = 4;                    ///< per pixel
    std::uint64_t scene = 0;            ///< caller's number, returned with the answer
    bool edges = false;                 ///< the pixels are the blurred ones
    /// Scene of the picture that has the holes; if the pictures of another scene have replaced it,
    /// the request is dropped. Null: the scene of the current pictures.
    std::shared_ptr<const Scene> source{};
};

/// The rendered pixels: the same values as in RenderedPicture, one for each of `pixels`.
struct HoleAnswer {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< in ascending order
    std::vector<std::array<std::uint8_t, 4>> colour;
    std::vector<float> depth;
    std::vector<std::uint8_t> id;
    std::vector<LightWords> light;
    int samples = 0;          ///< per pixel
    std::uint64_t scene = 0;  ///< from the request
    bool edges = false;       ///< from the request
};

}  // namespace mfar
