#pragma once

#include "base/light_word.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

inline constexpr int kMostHoleSamples = 256;

/// Request to render single pixels that the warp cannot take from finished pictures, or can only
/// show blurred.
struct HoleRequest {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< row-major indices, in any order
    int samples = 4;                    ///< samples per pixel, [1, kMostHoleSamples]
    std::uint64_t scene = 0;            ///< chosen by the caller, copied to the answer
    bool edges = false;  ///< true: the warp blurs these pixels; false: no picture shows them
    /// Scene of the traced picture in which the pixels are missing or blurred. The request is
    /// dropped if this scene is neither shown nor traced any more. Null: the scene that is traced
    /// now.
    std::shared_ptr<const Scene> source{};
    std::vector<RigidTransform> poses{};  ///< T_world_object; empty if no object moves
};

/// Answer to a HoleRequest. Each vector except `poses` has one value per entry of `pixels`, as
/// defined in RenderedPicture.
struct HoleAnswer {
    RenderView view;
    std::vector<std::uint32_t> pixels;  ///< in ascending order
    std::vector<std::array<std::uint8_t, 4>> colour;
    std::vector<float> depth;
    std::vector<std::uint8_t> id;
    std::vector<LightWords> light;
    int samples = 0;
    std::uint64_t scene = 0;
    bool edges = false;
    std::vector<RigidTransform> poses{};  ///< copy of HoleRequest::poses
};

}  // namespace mfar
