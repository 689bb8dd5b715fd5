#pragma once

#include <cstddef>

namespace mfar {

/// Asks the kernel for large pages, because providing thousands of small pages takes milliseconds.
/// Must be called before the memory is used. The kernel may ignore the request.
void preferLargePages(void* memory, std::size_t bytes);

/// Zeroed memory in large pages, if the kernel has some. The kernel provides a page when it is
/// first used, which may take milliseconds for a large page.
class LargePages {
public:
    static constexpr std::size_t kPage = std::size_t{2} << 20;  ///< bytes of a large page

    /// Allocates at least `bytes` bytes, aligned to a large page. Throws std::bad_alloc.
    explicit LargePages(std::size_t bytes);
    ~LargePages();
    LargePages(LargePages&& other) noexcept;
    LargePages& operator=(LargePages&& other) noexcept;

    [[nodiscard]] std::byte* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Makes the kernel provide all pages now.
    void provide();

private:
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace mfar
