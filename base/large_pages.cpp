#include "base/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace mfar {

void preferLargePages(void* memory, std::size_t bytes) {
    constexpr std::uintptr_t kSmallPage = 4096;
    const auto first = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (first + kSmallPage - 1) & ~(kSmallPage - 1);
    const std::uintptr_t end = (first + bytes) & ~(kSmallPage - 1);
    if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace mfar
