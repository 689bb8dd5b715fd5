#pragma once

#include "base/light_word.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Pixels of a view that no older picture shows, or shows blurred, to be rendered for themselves.
struct HoleRequest {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< row-major indices, in any order
    int samples = 4;                    ///< of each
    std::uint64_t scene = 0;            ///< whatever the answer is to be recognised by
    bool edges = false;                 ///< those that are blurred
    /// Of the picture that has the holes, which another one may already be made for: then they are
    /// left. None: the scene of the pictures.
    std::shared_ptr<const Scene> source{};
};

/// What is seen through them: as RenderedPicture, for each of `pixels`.
struct HoleAnswer {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< rising
    std::vector<std::array<std::uint8_t, 4>> colour;
    std::vector<float> depth;
    std::vector<std::uint8_t> id;
    std::vector<LightWords> light;
    int samples = 0;          ///< of each
    std::uint64_t scene = 0;  ///< the request's
    bool edges = false;       ///< the request's
};

}  // namespace mfar
