#pragma once

#include "base/image_view.h"
#include "base/zeroed_array.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace mfar {

/// A view of rows of values in host memory, e.g. of a picture. It does not own them.
template <class T>
struct Rows {
    T* data = nullptr;
    std::ptrdiff_t pitch = 0;  ///< elements from one row to the next
    Size size;                 ///< width: number of elements in a row; height: number of rows

    [[nodiscard]] T* operator[](int y) const { return data + y * pitch; }
    // NOLINTNEXTLINE(google-explicit-constructor): as T* converts to const T*
    operator Rows<const T>() const
        requires(!std::is_const_v<T>)
    {
        return {data, pitch, size};
    }
};

/// Rows that own their memory, see ZeroedArray. Each row begins on a cache line if kAlignment is a
/// multiple of sizeof(T). At least kPadding bytes after each row may be read and written, so that
/// SIMD loops need no scalar tail.
template <class T>
class AlignedRows {
public:
    static constexpr std::size_t kAlignment = ZeroedArray<T>::kAlignment;  ///< bytes
    static constexpr std::size_t kPadding = 64;                            ///< bytes

    AlignedRows() = default;
    explicit AlignedRows(Size size)
        : memory_(static_cast<std::size_t>(pitchFor(size.width)) * std::max(size.height, 1)),
          rows_{memory_.data(), pitchFor(size.width), size} {}
    AlignedRows(AlignedRows&& other) noexcept
        : memory_(std::move(other.memory_)), rows_(std::exchange(other.rows_, {})) {}
    AlignedRows& operator=(AlignedRows&& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(rows_, other.rows_);
        return *this;
    }

    [[nodiscard]] Size size() const { return rows_.size; }
    [[nodiscard]] std::ptrdiff_t pitch() const { return rows_.pitch; }
    [[nodiscard]] T* operator[](int y) { return rows_[y]; }
    [[nodiscard]] const T* operator[](int y) const { return rows_[y]; }
    [[nodiscard]] Rows<T> rows() { return rows_; }
    [[nodiscard]] Rows<const T> rows() const { return rows_; }

private:
    static std::ptrdiff_t pitchFor(int width) {
        const std::size_t bytes = static_cast<std::size_t>(width) * sizeof(T) + kPadding;
        const std::size_t lines = (bytes + kAlignment - 1) / kAlignment;
        // The pitch is a whole number of elements. If kAlignment is not a multiple of sizeof(T),
        // only row 0 is sure to begin on a cache line.
        return static_cast<std::ptrdiff_t>((lines * kAlignment + sizeof(T) - 1) / sizeof(T));
    }

    ZeroedArray<T> memory_;
    Rows<T> rows_;
};

}  // namespace mfar
