#include "base/large_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kSmallPage = 4096;

}  // namespace

void preferLargePages(void* memory, std::size_t bytes) {
    const auto first = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (first + kSmallPage - 1) & ~(kSmallPage - 1);
    const std::uintptr_t end = (first + bytes) & ~(kSmallPage - 1);
    if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

LargePages::LargePages(std::size_t bytes) : size_((bytes + kPage - 1) / kPage * kPage) {
    // The kernel aligns a mapping to small pages only. So the mapping is one large page longer than
    // needed, and the parts before and after the aligned memory are unmapped.
    const std::size_t mapped = size_ + kPage;
    void* memory =
        mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    auto* first = static_cast<std::byte*>(memory);
    const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(first) % kPage) % kPage;
    data_ = first + before;
    if (before > 0) munmap(first, before);
    if (before < kPage) munmap(data_ + size_, kPage - before);
    preferLargePages(data_, size_);
}

LargePages::~LargePages() {
    if (data_ != nullptr) munmap(data_, size_);
}

LargePages::LargePages(LargePages&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

LargePages& LargePages::operator=(LargePages&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

void LargePages::provide() {
    for (std::size_t at = 0; at < size_; at += kSmallPage) {
        volatile std::byte& byte = data_[at];
        byte = byte;
    }
}

}  // namespace mfar
