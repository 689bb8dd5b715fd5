#include "pipeline/render/film_memory.h"

#include <algorithm>
#include <utility>

namespace mfar {

LargePages FilmMemory::newPages() const {
    return LargePages(std::max(blockBytes_, LargePages::kPage));
}

// The caller has locked mutex_. take() returns the last entry of free_. So the blocks are added
// from the last to the first, and memory is used in ascending order.
void FilmMemory::add(LargePages pages) {
    for (std::size_t i = pages.size() / blockBytes_; i > 0; --i)
        free_.push_back(pages.data() + (i - 1) * blockBytes_);
    pages_.push_back(std::move(pages));
}

std::byte* FilmMemory::take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) add(newPages());
    std::byte* out = free_.back();
    free_.pop_back();
    return out;
}

void FilmMemory::giveBack(std::span<std::byte* const> blocks) {
    const std::scoped_lock lock(mutex_);
    free_.insert(free_.end(), blocks.begin(), blocks.end());
}

std::size_t FilmMemory::ready() const {
    const std::scoped_lock lock(mutex_);
    return free_.size();
}

void FilmMemory::provide(std::size_t blocks) {
    while (ready() < blocks) {
        LargePages pages = newPages();
        pages.provide();
        const std::scoped_lock lock(mutex_);
        // take() takes blocks from the end of free_. The new blocks are put before the free ones,
        // so that blocks that were already used are taken first.
        std::vector<std::byte*> used = std::exchange(free_, {});
        add(std::move(pages));
        free_.insert(free_.end(), used.begin(), used.end());
    }
}

}  // namespace mfar
