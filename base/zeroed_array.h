#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace mfar {

/// An array of fixed size that owns its memory. It is initially zero and aligned to a cache line.
/// The kernel provides the zeroed pages of a large array when they are first used, so that an
/// unused part costs neither time nor memory. Throws std::bad_alloc.
template <class T>
class ZeroedArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    static constexpr std::size_t kAlignment = 64;

    ZeroedArray() = default;
    explicit ZeroedArray(std::size_t size) : size_(size) {
        // Not aligned_alloc(): its memory is not zero, and clearing it would write to every page.
        std::size_t bytes = std::max<std::size_t>(size, 1) * sizeof(T) + kAlignment;
        memory_.reset(std::calloc(bytes, 1));
        if (!memory_) throw std::bad_alloc();
        void* first = memory_.get();
        data_ = static_cast<T*>(std::align(kAlignment, bytes - kAlignment, first, bytes));
    }
    ZeroedArray(ZeroedArray&& other) noexcept
        : memory_(std::move(other.memory_)), data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)) {}
    ZeroedArray& operator=(ZeroedArray&& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    [[nodiscard]] T* data() { return data_; }
    [[nodiscard]] const T* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    std::unique_ptr<void, Free> memory_;
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace mfar
