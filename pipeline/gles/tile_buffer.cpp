#include "pipeline/gles/tile_buffer.h"

#include <algorithm>
#include <span>

namespace mfar {
namespace {

std::uint32_t headerOf(TileWork::Draw draw) {
    switch (draw) {
    case TileWork::Draw::Tiles: return 0;
    case TileWork::Draw::Whole: return 1;
    case TileWork::Draw::WholeEnlarged: break;
    }
    return 2;
}

}  // namespace

TileBuffer::TileBuffer(Size video)
    : entries_(1 + TileWork::everything(tilesOf(video)).flags.size()) {
    buffer_ = gpu::Buffer(sizeof(entries_.front()) * entries_.size());
    set(TileWork::everything(tilesOf(video)));
}

void TileBuffer::set(const TileWork& work) {
    work_ = work;
    entries_[0] = {headerOf(work.draw), static_cast<std::uint32_t>(work.changed)};
    for (std::size_t i = 0; i < work.flags.size(); ++i)
        entries_[1 + i] = {work.flags[i].changed, work.flags[i].matched};
    if (entries_ == uploaded_) return;
    buffer_.write(std::span<const Entries::value_type>(entries_));
    uploaded_ = entries_;
}

bool TileBuffer::holds(const TileWork& work) const {
    const auto alike = [](const TileWork::Tile& a, const TileWork::Tile& b) {
        return a.changed == b.changed && a.matched == b.matched;
    };
    return work_.draw == work.draw && work_.changed == work.changed &&
           std::ranges::equal(work_.flags, work.flags, alike);
}

}  // namespace mfar
