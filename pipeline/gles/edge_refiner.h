#pragma once

#include "base/gl/fence.h"
#include "base/gl/pass.h"
#include "pipeline/slices/hole_request.h"
#include "pipeline/warp/pass_params.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Replaces what a look-up blurs: where an older picture's pixel mixes two surfaces, or has detail
/// as fine as a pixel, a warped picture is wrong by far the most. While the camera rests, those
/// pixels are listed by their contrast, rendered for themselves like holes, and shown until it
/// moves.
class EdgeRefiner {
public:
    static constexpr int kLevels = params::kContrastLevels;

    /// See WarpOptions. Lists `most` pixels at most, unless more have the very highest contrast;
    /// takes answers of so many.
    EdgeRefiner(Size layer, double share, int most, int fadeFrames);

    /// Lists the pixels of a look-up's `colour` (RGBA8 premultiplied) and `state` within `where`.
    /// Forgets the list and the answer before.
    void list(const gpu::Texture& colour, const gpu::Texture& state, const PixelRect& where);
    /// Row-major indices, ascending, once the GPU has finished them: never waits.
    std::optional<std::vector<std::uint32_t>> poll();
    /// To pixels that poll() gave; others are left out.
    void answer(const HoleAnswer& answer);
    /// Replaces the pixels, a little more with each frame, in a `colour` of the same pose.
    void show(const gpu::Texture& colour);
    /// The camera has moved, or what it sees has changed.
    void drop();

private:
    struct Entry {
        std::uint32_t pixel, before, rendered, unused;
    };

    Size layer_;
    double share_, step_;
    int most_;
    gpu::Buffer counts_, list_, entries_;
    std::optional<gpu::Fence> fence_;                   // of the list
    std::vector<std::array<std::uint32_t, 2>> listed_;  // pixel, colour; ascending
    params::RefineEdges params_{};
    double shown_ = 0;  // share of the answer, 0: there is none
    gpu::ComputePass<params::RefineEdges> count_, choose_, sharpen_;
};

}  // namespace mfar
