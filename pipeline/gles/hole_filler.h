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

/// Lists the pixels that the look-up left at least partly open, fills them from their surroundings,
/// and lets the host read the list a frame or two later. Cracks (most neighbours show the same
/// surface) are always filled; other holes are filled by push-pull on request.
class HoleFiller {
public:
    static constexpr int kLevels = 6;

    explicit HoleFiller(Size layer);

    /// Starts an empty list for the layer's pixels `where`.
    void begin(const PixelRect& where, bool pushPull);
    /// Dispatch commands and count of the list: see warp_rest.comp.
    [[nodiscard]] const gpu::Buffer& commands() const { return lists_[current_].commands; }
    [[nodiscard]] const gpu::Buffer& entries() const { return lists_[current_].entries; }
    /// Group counts of the pyramid's dispatches, which take effect with the list's first entry.
    using Command = params::DispatchGroups;
    [[nodiscard]] const std::array<Command, kLevels>& wanted() const { return wanted_; }
    [[nodiscard]] int levels() const { return params_.levelCount; }

    /// Fills `colour` (RGBA8 premultiplied); `colour` and `state` are the results of ViewLookUp.
    /// `wantList`: this frame's list will be read, unless another one is in transfer.
    void fill(const gpu::Texture& colour, const gpu::Texture& state, bool wantList);

    /// The holes of the frame with `wantList`, once the GPU has finished it. Never waits.
    std::optional<WarpHoles> poll();
    /// True while a list is in transfer to the host.
    [[nodiscard]] bool isPending() const { return fence_.has_value(); }
    /// Discards a list that is in transfer.
    void drop() { fence_.reset(); }

private:
    static_assert(kLevels == std::size(params::FillHoles{}.levels));
    struct Lists {
        gpu::Buffer commands, entries;
    };

    void pull(const gpu::Texture& colour, const gpu::Texture& state);

    Size layer_;
    std::array<Lists, 2> lists_;  // one may be in transfer to the host
    std::size_t current_ = 0;
    std::optional<gpu::Fence> fence_;  // of the list that is in transfer
    gpu::Buffer pyramid_;
    params::FillHoles params_{};
    std::array<Command, kLevels> wanted_{};
    std::array<int, kLevels> rows_{};
    gpu::ComputePass<params::FillHoles> first_, pull_, fill_;
};

}  // namespace mfar
