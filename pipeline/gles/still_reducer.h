#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/still.h"

#include <array>
#include <cstdint>

namespace mfar {

/// Reduces stills without aliasing. Needs a current GL context for its whole lifetime.
class StillReducer {
public:
    /// Along each axis, `to` must be at least one pixel and at most `from`.
    StillReducer(Size from, Size to);

    void run(const gpu::Texture& picture);
    /// The reduced picture of the last run: RGBA8, linear filter.
    [[nodiscard]] const gpu::Texture& picture() const { return reduced_; }

private:
    std::array<float, 2> scale_;
    gpu::Texture narrow_, reduced_;
    gpu::Framebuffer narrowTarget_, reducedTarget_;
    gpu::DrawPass<params::ReduceStill> across_, down_;
};

}  // namespace mfar
