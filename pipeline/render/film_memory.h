#pragma once

#include "base/large_pages.h"

#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace mfar {

/// Memory of films, in blocks of one size. Films share it, so that a new picture gets the blocks of
/// an old picture. It grows when take() or provide() needs more blocks, and never shrinks. All
/// functions may be called by several threads at the same time.
class FilmMemory {
public:
    explicit FilmMemory(std::size_t blockBytes) : blockBytes_(blockBytes) {}

    /// Returns a block with undefined content. Throws std::bad_alloc.
    [[nodiscard]] std::byte* take();
    void giveBack(std::span<std::byte* const> blocks);

    /// Number of blocks that take() can return without allocating memory.
    [[nodiscard]] std::size_t ready() const;
    /// Allocates memory until take() can return at least `blocks` blocks without allocating. The
    /// kernel provides all pages of these blocks now, so that their first use does not wait for it.
    /// Throws std::bad_alloc.
    void provide(std::size_t blocks);

private:
    [[nodiscard]] LargePages newPages() const;
    void add(LargePages pages);

    const std::size_t blockBytes_;
    mutable std::mutex mutex_;
    std::vector<LargePages> pages_;
    std::vector<std::byte*> free_;  // take() returns the last one
};

}  // namespace mfar
