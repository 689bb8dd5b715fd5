#pragma once

#include "base/geometry.h"
#include "base/gl/fence.h"
#include "base/gl/pass.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/warp_step.h"

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

namespace mfar {

/// Keeps the list of the pixels of which the look-up left something open, fills them from their
/// surroundings, and lets the host read the list a frame or two later. Cracks, of which most
/// neighbours show the same surface, are always filled; other holes by push-pull, if asked for.
class HoleFiller {
public:
    static constexpr int kLevels = 6;

    explicit HoleFiller(Size layer);

    /// An empty list, to be filled for the layer's pixels `where`.
    void begin(const PixelRect& where, bool pushPull);
    /// Of the list: see warp_rest.comp.
    [[nodiscard]] const gpu::Buffer& commands() const { return lists_[current_].commands; }
    [[nodiscard]] const gpu::Buffer& entries() const { return lists_[current_].entries; }
    /// Groups of the pyramid's dispatches, which the list's first entry opens.
    using Command = params::DispatchGroups;
    [[nodiscard]] const std::array<Command, kLevels>& wanted() const { return wanted_; }
    [[nodiscard]] int levels() const { return params_.levelCount; }

    /// `colour` (RGBA8 premultiplied) and `state` as ViewLookUp leaves them; writes into `colour`.
    /// `wantList`: this frame's list is to be read, if none is under way.
    void fill(const gpu::Texture& colour, const gpu::Texture& state, bool wantList);

    /// Of the frame whose list was wanted, once the GPU has finished it: never waits.
    std::optional<WarpHoles> poll();
    /// A list is under way to the host.
    [[nodiscard]] bool isPending() const { return fence_.has_value(); }
    /// Forgets a list that is under way.
    void drop() { fence_.reset(); }

private:
    static_assert(kLevels == std::size(params::FillHoles{}.levels));
    struct Lists {
        gpu::Buffer commands, entries;
    };

    void pull(const gpu::Texture& colour, const gpu::Texture& state);

    Size layer_;
    std::array<Lists, 2> lists_;  // one may be under way to the host
    std::size_t current_ = 0;
    std::optional<gpu::Fence> fence_;  // of the other one
    gpu::Buffer pyramid_;
    params::FillHoles params_{};
    std::array<Command, kLevels> wanted_{};
    std::array<int, kLevels> rows_{};
    gpu::ComputePass<params::FillHoles> first_, pull_, fill_;
};

}  // namespace mfar
