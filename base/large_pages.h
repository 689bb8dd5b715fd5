#pragma once

#include <cstddef>

namespace mfar {

/// Asks the kernel for large pages, because it takes milliseconds to provide thousands of small
/// ones. Must be called before the memory is used. The kernel may ignore the request.
void preferLargePages(void* memory, std::size_t bytes);

}  // namespace mfar
