#pragma once

#include "base/geometry.h"
#include "base/gl/fence.h"
#include "base/gl/pass.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

namespace mfar {

/// Lists pixels that the warp left without a known colour, and fills them from their surroundings.
/// The CPU can read the list one or two frames later. Pixels in cracks of one pixel width are
/// always filled, because most of their neighbours show the same surface. HoleFilling selects which
/// larger areas are also filled, by push-pull.
class HoleFiller {
public:
    static constexpr int kLevels = 6;
    using Command = params::DispatchGroups;
    /// Command of a list without entries. The shader that adds entries counts rows (y) of kListRow
    /// entries.
    static constexpr Command kEmptyList{params::kListColumns, 0, 1, 0};

    explicit HoleFiller(Size layer);

    /// Begins an empty list of pixels in `where`. `filling` selects the pixels that are filled
    /// besides cracks.
    void begin(const PixelRect& where, HoleFilling filling);
    /// Dispatch commands and length of the list; see warp_rest.comp.
    [[nodiscard]] const gpu::Buffer& commands() const { return lists_[current_].commands; }
    [[nodiscard]] const gpu::Buffer& entries() const { return lists_[current_].entries; }
    /// Numbers of workgroups for each level of the pyramid. warp_rest.comp copies them to
    /// commands() when it finds the first pixel without a known colour.
    [[nodiscard]] const std::array<Command, kLevels>& wanted() const { return wanted_; }
    [[nodiscard]] int levels() const { return params_.levelCount; }

    /// Fills pixels of `colour` (RGBA8 premultiplied). `colour` and `state` are the results of
    /// ViewLookUp. With `wantList`, the CPU reads back this frame's list, unless it is still
    /// reading back an older list.
    void fill(const gpu::Texture& colour, const gpu::Texture& state, bool wantList);

    /// Returns the list that fill() began to read back last, or nullopt until the GPU has finished
    /// it. Returns each list only once. Never waits.
    std::optional<WarpHoles> poll();
    [[nodiscard]] bool isPending() const { return fence_.has_value(); }
    void drop() { fence_.reset(); }

private:
    static_assert(kLevels == std::size(params::FillHoles{}.levels));
    struct Lists {
        gpu::Buffer commands, entries;
    };

    void pull(const gpu::Texture& colour, const gpu::Texture& state);

    Size layer_;
    std::array<Lists, 2> lists_;
    std::size_t current_ = 0;
    std::optional<gpu::Fence> fence_;
    gpu::Buffer pyramid_;
    params::FillHoles params_{};
    std::array<Command, kLevels> wanted_{};
    std::array<int, kLevels> rows_{};
    gpu::ComputePass<params::FillHoles> first_, pull_, fill_;
};

}  // namespace mfar
