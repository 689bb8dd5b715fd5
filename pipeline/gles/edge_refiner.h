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

/// Sharpens a warped picture while the camera rests. The warp blurs edges and detail as fine as a
/// pixel. The blurred pixels are found by their high contrast to their neighbours, listed, and
/// rendered individually. The rendered colours are shown until the camera moves.
class EdgeRefiner {
public:
    static constexpr int kLevels = params::kContrastLevels;

    /// Arguments: see WarpOptions. At most `most` pixels are listed, except that all pixels with
    /// the highest contrast level are always listed. answer() uses at most `most` pixels.
    EdgeRefiner(Size layer, double share, int most, int fadeFrames);

    /// Discards the previous list and its colours. Starts to list pixels in `where` from results of
    /// ViewLookUp: `colour` (RGBA8 premultiplied) and `state`.
    void list(const gpu::Texture& colour, const gpu::Texture& state, const PixelRect& where);
    /// Returns the row-major indices of the listed pixels in ascending order, or nullopt until the
    /// GPU has finished the list. Never waits.
    std::optional<std::vector<std::uint32_t>> poll();
    /// Sets the rendered colours of listed pixels. The pixels in `answer` must be in ascending
    /// order. Those that are not listed are ignored.
    void answer(const HoleAnswer& answer);
    /// Blends the rendered colours over the listed pixels of `colour`, a picture that must have
    /// been warped to the same pose as in list(). The rendered colours fade in from frame to frame.
    void show(const gpu::Texture& colour);
    /// Discards list and colours. Must be called when the camera has moved or the scene has
    /// changed.
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
