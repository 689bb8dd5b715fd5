#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace mfar {

/// Numbers of bytes that were copied from CPU memory to the GPU (uploaded) and back (downloaded).
struct Transfers {
    std::uint64_t uploadedBytes = 0, downloadedBytes = 0;
};

/// The GPU's copy of a field. Implemented in pipeline/gles.
class DeviceCopy {
public:
    DeviceCopy() = default;
    DeviceCopy(const DeviceCopy&) = delete;
    DeviceCopy& operator=(const DeviceCopy&) = delete;
    virtual ~DeviceCopy() = default;

    virtual void upload(const void* data, std::ptrdiff_t pitch) = 0;
    /// Brings all rows of `data` up to date, and waits for the GPU. Returns the number of copied
    /// bytes. `data` contains zeros, or what the last download of the same field left there.
    virtual std::size_t download(void* data, std::ptrdiff_t pitch) = 0;
};

/// The result of a step: rows of T in CPU memory (host), on the GPU (device) or in both. The step
/// owns the rows that it writes, and tells the field where they are. If rows are needed on the
/// other side, host() or device() copies them. The field owns the copies.
template <class T>
class Field {
public:
    /// `transfers` counts the copied bytes and must outlive the field. Null: nothing is counted.
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
    /// Reports new rows in CPU memory that other steps may change through edit().
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

    /// Returns the rows in CPU memory. If they are only on the GPU, downloads them and waits for
    /// the GPU. Returns rows without data if nothing was written yet.
    [[nodiscard]] Rows<const T> host() const {
        if (!isOnHost() && isOnDevice()) {
            if (downloaded_.size() != size_) downloaded_ = AlignedRows<T>(size_);
            const std::size_t copied =
                device_->download(downloaded_[0], downloaded_.pitch() * sizeof(T));
            if (transfers_ != nullptr) transfers_->downloadedBytes += copied;
            editable_ = downloaded_.rows();
            host_ = editable_;
        }
        return host_;
    }
    /// Returns the rows in CPU memory, so that the caller can change them. The copy on the GPU
    /// becomes invalid. May be called only if the last report was writtenOnDevice(), or
    /// writtenOnHost() with writable rows (Rows<T>).
    [[nodiscard]] Rows<T> edit() {
        (void)host();
        device_ = nullptr;
        return editable_;
    }
    /// Returns the GPU's copy, after an upload if necessary. `make` creates GPU memory for a field
    /// of this size. It is called for the first upload and after changes of the size.
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
    // Mutable, because host() and device() are const but store copies.
    mutable Rows<const T> host_;
    mutable Rows<T> editable_;
    mutable DeviceCopy* device_ = nullptr;
    mutable AlignedRows<T> downloaded_;
    mutable std::unique_ptr<DeviceCopy> uploaded_;
    mutable Size uploadedSize_{};
};

}  // namespace mfar
