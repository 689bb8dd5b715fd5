#pragma once

#include <cstddef>

namespace mfar {

/// Asks the kernel to provide this memory in large pages, because thousands of small pages take
/// milliseconds to provide. Call it before the memory is used. The kernel may ignore it.
void preferLargePages(void* memory, std::size_t bytes);

}  // namespace mfar
