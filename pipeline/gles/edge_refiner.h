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

/// Replaces pixels that the warp blurs. The largest errors of a warped picture are where a traced
/// pixel mixes two surfaces or shows detail as fine as a pixel. While the camera rests, these
/// pixels are listed by their contrast and rendered individually. They are shown until the camera
/// moves.
class EdgeRefiner {
public:
    static constexpr int kLevels = params::kContrastLevels;

    /// See WarpOptions for the arguments. Lists at most `most` pixels. But if more pixels than that
    /// have the highest contrast level, all of them are listed. answer() uses at most `most`
    /// pixels.
    EdgeRefiner(Size layer, double share, int most, int fadeFrames);

    /// Discards the previous list and its colours. Starts to list pixels in `where` from results of
    /// ViewLookUp: `colour` (RGBA8 premultiplied) and `state`.
    void list(const gpu::Texture& colour, const gpu::Texture& state, const PixelRect& where);
    /// Returns the row-major indices of the listed pixels, ascending. Empty until the GPU has
    /// finished the list. Never waits.
    std::optional<std::vector<std::uint32_t>> poll();
    /// Sets the rendered colours of pixels that poll() returned. Other pixels are ignored.
    void answer(const HoleAnswer& answer);
    /// Blends the colours of answer() over the listed pixels in `colour`, which must be warped to
    /// the pose of the list. The weight of the colours grows with each frame.
    void show(const gpu::Texture& colour);
    /// Must be called when the camera has moved or the scene has changed.
    void drop();

private:
    struct Entry {
        std::uint32_t pixel, before, rendered, unused;
    };

    Size layer_;
    double share_, step_;
    int most_;
    gpu::Buffer counts_, list_, entries_;
    std::optional<gpu::Fence> fence_;
    std::vector<std::array<std::uint32_t, 2>> listed_;
    params::RefineEdges params_{};
    double shown_ = 0;
    gpu::ComputePass<params::RefineEdges> count_, choose_, sharpen_;
};

}  // namespace mfar
