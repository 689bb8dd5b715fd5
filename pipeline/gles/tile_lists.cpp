#include "pipeline/gles/tile_lists.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/flow/least_texture.h"

#include <algorithm>
#include <array>

namespace mfar {
namespace {

constexpr int kTileGroup = 8;  // width and height of the shaders' workgroups [invocations]

gpu::Groups groupsOf(Size size) {
    return {gpu::groupsFor(size.width, kTileGroup), gpu::groupsFor(size.height, kTileGroup), 1};
}

}  // namespace

TileLists::TileLists(Size cells, int levels)
    : cells_(cells),
      tiles_{divideUp(cells.width, kCellsPerTile), divideUp(cells.height, kCellsPerTile)},
      flags_(sizeof(std::uint32_t) * tiles_.width * tiles_.height), commands_(16UL * levels),
      flag_("flow_flag.comp"), list_("flow_list.comp") {
    int entries = 0;
    for (int l = 0; l < levels; ++l) {
        const Size groups{divideUp(tiles_.width, 1 << l), divideUp(tiles_.height, 1 << l)};
        levels_.push_back({groups, entries});
        entries += groups.width * groups.height;
    }
    lists_ = gpu::Buffer(sizeof(std::uint32_t) * entries);
}

void TileLists::clear() {
    countBefore_ = count();
    const std::vector<std::array<std::uint32_t, 4>> none(levels_.size(), {0, 1, 1, 0});
    commands_.write(std::span(none));
}

void TileLists::find(const Field& field, const TileBuffer& tiles) {
    clear();
    const TileWork& work = tiles.work();
    if (work.matched == 0) return;
    flag_.run({.tileColumns = tiles_.width,
               .tileRows = tiles_.height,
               .columns = cells_.width,
               .rows = cells_.height,
               .field = field.vectors,
               .errors = field.errors,
               .leastTexture = leastTexture(work.noise)},
              {gpu::storage(1, field.cells), gpu::storage(2, flags_)}, groupsOf(tiles_));
    for (int l = 0; l < static_cast<int>(levels_.size()); ++l) {
        const Level& level = levels_[l];
        // A group is listed if a flagged tile is within this margin around it [tiles]. The search
        // in a group reads the adjacent groups of the next coarser pyramid level, so the margin
        // grows from level to level.
        const int margin = (2 << l) - 2;
        list_.run({.tileColumns = tiles_.width,
                   .tileRows = tiles_.height,
                   .groupColumns = level.groups.width,
                   .groupRows = level.groups.height,
                   .tilesPerGroup = 1 << l,
                   .margin = margin,
                   .command = l,
                   .first = level.first},
                  {gpu::storage(0, flags_), gpu::storage(1, commands_), gpu::storage(2, lists_)},
                  groupsOf(level.groups));
    }
}

int TileLists::count() const {
    return static_cast<int>(commands_.read<std::uint32_t>(1)[0]);
}

std::vector<bool> TileLists::read() const {
    std::vector<bool> out(static_cast<std::size_t>(tiles_.width) * tiles_.height);
    const auto listed = static_cast<std::size_t>(count());
    if (listed == 0) return out;
    for (const std::uint32_t tile : lists_.read<std::uint32_t>(listed))
        out[static_cast<std::size_t>(tile >> 16) * tiles_.width + (tile & 0xFFFF)] = true;
    return out;
}

}  // namespace mfar
