#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/patch_flow.h"

#include <span>
#include <vector>

namespace mfar::simd {

/// A flag (1 or 0) for each tile of 16x16 px, row-major.
struct TileMask {
    Size size;
    std::vector<std::uint8_t> flags;

    explicit TileMask(Size tiles = {})
        : size(tiles), flags(static_cast<std::size_t>(tiles.width) * tiles.height) {}
    [[nodiscard]] std::uint8_t& at(int x, int y) {
        return flags[static_cast<std::size_t>(y) * size.width + x];
    }
    [[nodiscard]] std::uint8_t at(int x, int y) const {
        return flags[static_cast<std::size_t>(y) * size.width + x];
    }
};
/// Sets the flag of each tile in `out` to 1 if `in` has a flag of 1 at most `margin` tiles away
/// along each axis, else to 0. All masks have the same size. `between`: temporary memory.
void widen(const TileMask& in, int margin, TileMask& between, TileMask& out);

/// Finds the tiles that do not match along epipolar lines and must be searched in two dimensions.
/// For each pyramid level, lists the groups of 4x4 cells that this search processes. CPU version of
/// flow_flag.comp and flow_list.comp.
class TileSearch {
public:
    struct Group {
        int x, y;
    };

    TileSearch(Size cells, int levels);

    /// `field`: the flow along epipolar lines. `errors`: two-way errors of its cells, row-major.
    /// `noise`: standard deviation of the video's noise [grey levels].
    void find(const FlowPlanes& field, std::span<const ErrorCell> errors, double noise);
    void clear();

    [[nodiscard]] std::span<const Group> groups(int level) const {
        return groups_[static_cast<std::size_t>(level)];
    }
    /// A flag for each tile, row-major: true if groups(0) contains the tile.
    [[nodiscard]] const std::vector<bool>& tiles() const { return listed_; }
    [[nodiscard]] int count() const { return static_cast<int>(groups_[0].size()); }

private:
    void flag(const FlowPlanes& field, std::span<const ErrorCell> errors, double noise);

    TileMask unexplained_, flagged_;
    std::vector<std::vector<Group>> groups_;
    std::vector<bool> listed_;
};

}  // namespace mfar::simd
