#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace mfar {

/// Memory moved between host and GPU. Counts up; its reader takes differences.
struct Transfers {
    std::uint64_t uploadedBytes = 0, downloadedBytes = 0;
};

/// The GPU's copy of a field. pipeline/gles implements it; nobody else knows what is behind it.
class DeviceCopy {
public:
    DeviceCopy() = default;
    DeviceCopy(const DeviceCopy&) = delete;
    DeviceCopy& operator=(const DeviceCopy&) = delete;
    virtual ~DeviceCopy() = default;

    /// All rows; `pitch` bytes from one row to the next.
    virtual void upload(const void* data, std::ptrdiff_t pitch) = 0;
    /// The same the other way. Waits for the GPU.
    virtual void download(void* data, std::ptrdiff_t pitch) = 0;
};

/// The result of a step: rows of T that lie on the host, on the GPU or on both. The step that
/// writes it says where; a reader asks for the copy that it needs, and the rows move only then. The
/// memory of the newest copy belongs to the step, that of a moved copy to the field.
template <class T>
class Field {
public:
    /// `transfers` counts what moves and must outlive the field; null: not counted.
    explicit Field(Size size = {}, Transfers* transfers = nullptr)
        : size_(size), transfers_(transfers) {}

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(T) * static_cast<std::size_t>(size_.width) * size_.height;
    }

    /// The host's rows are new. Borrowed: valid until the next writtenOn...().
    void writtenOnHost(Rows<const T> rows) {
        host_ = rows;
        size_ = rows.size;
        device_ = nullptr;
        editable_ = {};
    }
    /// The same for rows that steps may draw into.
    void writtenOnHost(Rows<T> rows)
        requires(!std::is_const_v<T>)
    {
        writtenOnHost(Rows<const T>(rows));
        editable_ = rows;
    }
    /// The GPU's copy is new. Borrowed likewise.
    void writtenOnDevice(DeviceCopy& copy, Size size) {
        device_ = &copy;
        size_ = size;
        host_ = {};
        editable_ = {};
    }
    [[nodiscard]] bool isOnHost() const { return host_.data != nullptr; }
    [[nodiscard]] bool isOnDevice() const { return device_ != nullptr; }
    [[nodiscard]] bool isEmpty() const { return !isOnHost() && !isOnDevice(); }

    /// Rows on the host. Waits for the GPU where the newest copy is there.
    [[nodiscard]] Rows<const T> host() const {
        if (!isOnHost() && isOnDevice()) {
            if (downloaded_.size() != size_) downloaded_ = AlignedRows<T>(size_);
            device_->download(downloaded_[0], downloaded_.pitch() * sizeof(T));
            if (transfers_ != nullptr) transfers_->downloadedBytes += bytes();
            editable_ = downloaded_.rows();
            host_ = editable_;
        }
        return host_;
    }
    /// Rows on the host to draw into; they become the newest copy. Only for a field whose step gave
    /// editable rows, or whose newest copy was on the GPU.
    [[nodiscard]] Rows<T> edit() {
        (void)host();
        device_ = nullptr;
        return editable_;
    }
    /// The GPU's copy; `make` creates one of this field's size where rows of the host have to be
    /// uploaded for the first time.
    template <class Make>
    [[nodiscard]] DeviceCopy& device(const Make& make) const {
        if (!isOnDevice()) {
            if (!uploaded_ || uploadedSize_ != size_) {
                uploaded_ = make();
                uploadedSize_ = size_;
            }
            uploaded_->upload(host_.data, host_.pitch * static_cast<std::ptrdiff_t>(sizeof(T)));
            if (transfers_ != nullptr) transfers_->uploadedBytes += bytes();
            device_ = uploaded_.get();
        }
        return *device_;
    }

private:
    Size size_;
    Transfers* transfers_;
    // Reading moves rows, which changes no value.
    mutable Rows<const T> host_;            // no data: older than the GPU's copy
    mutable Rows<T> editable_;              // the same, where it may be drawn into
    mutable DeviceCopy* device_ = nullptr;  // null: older than the host's rows
    mutable AlignedRows<T> downloaded_;
    mutable std::unique_ptr<DeviceCopy> uploaded_;
    mutable Size uploadedSize_{};
};

}  // namespace mfar
