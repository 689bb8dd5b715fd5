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

/// Replaces the pixels that a look-up blurs. A warped picture has by far its largest errors where a
/// pixel of the older picture mixes two surfaces or has detail as fine as a pixel. While the camera
/// rests, those pixels are listed by their contrast, rendered individually like holes, and shown
/// until the camera moves.
class EdgeRefiner {
public:
    static constexpr int kLevels = params::kContrastLevels;

    /// See WarpOptions. Lists up to `most` pixels, or more if more have the very highest contrast;
    /// accepts answers of up to `most` pixels.
    EdgeRefiner(Size layer, double share, int most, int fadeFrames);

    /// Discards the previous list and answer, then lists the pixels of a look-up's `colour` (RGBA8
    /// premultiplied) and `state` within `where`.
    void list(const gpu::Texture& colour, const gpu::Texture& state, const PixelRect& where);
    /// Row-major pixel indices, ascending, once the GPU has finished them. Never waits.
    std::optional<std::vector<std::uint32_t>> poll();
    /// Answers pixels that poll() returned; other pixels are ignored.
    void answer(const HoleAnswer& answer);
    /// Replaces the pixels in a `colour` of the same pose, with a share that grows with each frame.
    void show(const gpu::Texture& colour);
    /// Call when the camera has moved or the scene has changed.
    void drop();

private:
    struct Entry {
        std::uint32_t pixel, before, rendered, unused;
    };

    Size layer_;
    double share_, step_;
    int most_;
    gpu::Buffer counts_, list_, entries_;
    std::optional<gpu::Fence> fence_;                   // set while the list is being made
    std::vector<std::array<std::uint32_t, 2>> listed_;  // pixel, colour; ascending by pixel
    params::RefineEdges params_{};
    double shown_ = 0;  // share of the answer; 0: there is no answer
    gpu::ComputePass<params::RefineEdges> count_, choose_, sharpen_;
};

}  // namespace mfar
