#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace mfar {

/// Number of bytes moved between host and GPU. The counters only increase; readers take
/// differences.
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

/// The result of a step: rows of T on the host, on the GPU or on both. The step that writes the
/// rows reports where they are. A reader requests the copy that it needs; only then are the rows
/// moved. The step owns the memory that it wrote; the field owns the memory of a moved copy.
template <class T>
class Field {
public:
    /// `transfers` counts the moved bytes and must outlive the field; null: they are not counted.
    explicit Field(Size size = {}, Transfers* transfers = nullptr)
        : size_(size), transfers_(transfers) {}

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(T) * static_cast<std::size_t>(size_.width) * size_.height;
    }

    /// Reports new rows on the host. They must remain valid until the next writtenOn...().
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
    /// Reports a new copy on the GPU. It must remain valid until the next writtenOn...().
    void writtenOnDevice(DeviceCopy& copy, Size size) {
        device_ = &copy;
        size_ = size;
        host_ = {};
        editable_ = {};
    }
    [[nodiscard]] bool isOnHost() const { return host_.data != nullptr; }
    [[nodiscard]] bool isOnDevice() const { return device_ != nullptr; }
    [[nodiscard]] bool isEmpty() const { return !isOnHost() && !isOnDevice(); }

    /// Returns the rows on the host. Waits for the GPU if the newest copy is there.
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
    /// Returns the rows on the host for drawing; they become the newest copy. The step must have
    /// reported rows that may be drawn into, or a copy on the GPU.
    [[nodiscard]] Rows<T> edit() {
        (void)host();
        device_ = nullptr;
        return editable_;
    }
    /// Returns the GPU's copy. `make` creates a copy of this field's size; it is called only when
    /// host rows are uploaded for the first time.
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
    // Mutable, because reading moves rows but changes no value.
    mutable Rows<const T> host_;            // without data: the GPU's copy is newer
    mutable Rows<T> editable_;              // the same rows, if they may be drawn into
    mutable DeviceCopy* device_ = nullptr;  // null: the host's rows are newer
    mutable AlignedRows<T> downloaded_;
    mutable std::unique_ptr<DeviceCopy> uploaded_;
    mutable Size uploadedSize_{};
};

}  // namespace mfar
