#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace mfar {

/// Numbers of bytes copied between CPU memory (host) and GPU. The counters only increase; readers
/// take differences.
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

    /// Writes all rows. `pitch`: bytes from the start of one row to the next.
    virtual void upload(const void* data, std::ptrdiff_t pitch) = 0;
    /// Reads all rows. Waits for the GPU.
    virtual void download(void* data, std::ptrdiff_t pitch) = 0;
};

/// The result of a step: rows of T in CPU memory (host), on the GPU or in both. The step that
/// writes the rows reports where they are. A reader calls host() or device(); only then are the
/// rows copied to there if necessary. The memory that a step wrote belongs to the step; the memory
/// of the other copy belongs to the field.
template <class T>
class Field {
public:
    /// `transfers` counts the copied bytes and must outlive the field; null: they are not counted.
    explicit Field(Size size = {}, Transfers* transfers = nullptr)
        : size_(size), transfers_(transfers) {}

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(T) * static_cast<std::size_t>(size_.width) * size_.height;
    }

    /// Reports new rows in CPU memory. They must remain valid until the next call of
    /// writtenOnHost() or writtenOnDevice().
    void writtenOnHost(Rows<const T> rows) {
        host_ = rows;
        size_ = rows.size;
        device_ = nullptr;
        editable_ = {};
    }
    /// Reports new rows in CPU memory that edit() may later return for drawing.
    void writtenOnHost(Rows<T> rows)
        requires(!std::is_const_v<T>)
    {
        writtenOnHost(Rows<const T>(rows));
        editable_ = rows;
    }
    /// Reports new rows on the GPU. `copy` must remain valid until the next call of writtenOnHost()
    /// or writtenOnDevice().
    void writtenOnDevice(DeviceCopy& copy, Size size) {
        device_ = &copy;
        size_ = size;
        host_ = {};
        editable_ = {};
    }
    [[nodiscard]] bool isOnHost() const { return host_.data != nullptr; }
    [[nodiscard]] bool isOnDevice() const { return device_ != nullptr; }
    [[nodiscard]] bool isEmpty() const { return !isOnHost() && !isOnDevice(); }

    /// Returns the rows in CPU memory. If only the GPU has them, waits for the GPU and downloads
    /// them.
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
    /// Returns the rows in CPU memory, so that the caller can draw into them. The copy on the GPU
    /// is then out of date. The step must have reported non-const rows, or rows on the GPU.
    [[nodiscard]] Rows<T> edit() {
        (void)host();
        device_ = nullptr;
        return editable_;
    }
    /// Returns the GPU's copy, and uploads the rows first if only the host has them. `make` creates
    /// a GPU copy of this field's size. It is called only for the first upload, and after the size
    /// has changed.
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
    // These members are mutable, because reading may copy the rows but changes no value.
    mutable Rows<const T> host_;            // no data: only the GPU has the rows
    mutable Rows<T> editable_;              // the rows of host_, if they may be drawn into
    mutable DeviceCopy* device_ = nullptr;  // null: only the host has the rows
    mutable AlignedRows<T> downloaded_;
    mutable std::unique_ptr<DeviceCopy> uploaded_;
    mutable Size uploadedSize_{};
};

}  // namespace mfar
