#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace mfar {

/// Bytes moved between host and GPU. Increasing counters; readers take differences.
struct Transfers {
    std::uint64_t uploadedBytes = 0, downloadedBytes = 0;
};

/// The GPU's copy of a field. Implemented in pipeline/gles; other code sees only this interface.
class DeviceCopy {
public:
    DeviceCopy() = default;
    DeviceCopy(const DeviceCopy&) = delete;
    DeviceCopy& operator=(const DeviceCopy&) = delete;
    virtual ~DeviceCopy() = default;

    /// Writes all rows; `pitch`: bytes from one row to the next.
    virtual void upload(const void* data, std::ptrdiff_t pitch) = 0;
    /// Reads all rows. Waits for the GPU.
    virtual void download(void* data, std::ptrdiff_t pitch) = 0;
};

/// The result of a step: rows of T on the host, on the GPU or on both. The step that writes it
/// states where; a reader requests the copy that it needs, and only then are the rows moved. The
/// newest copy's memory belongs to the step, a moved copy's memory to the field.
template <class T>
class Field {
public:
    /// `transfers` counts the bytes moved and must outlive the field; null: not counted.
    explicit Field(Size size = {}, Transfers* transfers = nullptr)
        : size_(size), transfers_(transfers) {}

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(T) * static_cast<std::size_t>(size_.width) * size_.height;
    }

    /// Reports new rows on the host. Borrowed: valid until the next writtenOn...().
    void writtenOnHost(Rows<const T> rows) {
        host_ = rows;
        size_ = rows.size;
        device_ = nullptr;
        editable_ = {};
    }
    /// As above, for rows that steps may draw into.
    void writtenOnHost(Rows<T> rows)
        requires(!std::is_const_v<T>)
    {
        writtenOnHost(Rows<const T>(rows));
        editable_ = rows;
    }
    /// Reports a new copy on the GPU. Borrowed: valid until the next writtenOn...().
    void writtenOnDevice(DeviceCopy& copy, Size size) {
        device_ = &copy;
        size_ = size;
        host_ = {};
        editable_ = {};
    }
    [[nodiscard]] bool isOnHost() const { return host_.data != nullptr; }
    [[nodiscard]] bool isOnDevice() const { return device_ != nullptr; }
    [[nodiscard]] bool isEmpty() const { return !isOnHost() && !isOnDevice(); }

    /// Rows on the host. Waits for the GPU if the newest copy is there.
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
    /// Rows on the host for drawing; they become the newest copy. Requires that the step gave
    /// editable rows or that the newest copy was on the GPU.
    [[nodiscard]] Rows<T> edit() {
        (void)host();
        device_ = nullptr;
        return editable_;
    }
    /// The GPU's copy; `make` creates one of this field's size when host rows are uploaded for the
    /// first time.
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
    // Mutable: reading moves rows but changes no value.
    mutable Rows<const T> host_;            // data is null: older than the GPU's copy
    mutable Rows<T> editable_;              // the same rows, where they are editable
    mutable DeviceCopy* device_ = nullptr;  // null: older than the host's rows
    mutable AlignedRows<T> downloaded_;
    mutable std::unique_ptr<DeviceCopy> uploaded_;
    mutable Size uploadedSize_{};
};

}  // namespace mfar
