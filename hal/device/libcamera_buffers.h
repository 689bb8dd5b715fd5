#pragma once

#include "hal/device/libcamera_compat.h"
#include "hal/device/picture_layout.h"

#include <cstddef>
#include <vector>

namespace mfar {

/// A buffer of a camera, mapped into this process's memory. It may outlive the camera. One
/// file (a dma-buf) may contain several planes.
class MappedPicture {
public:
    MappedPicture(const libcamera::FrameBuffer& buffer, const PictureLayout& layout);
    MappedPicture(const MappedPicture&) = delete;
    MappedPicture& operator=(const MappedPicture&) = delete;
    ~MappedPicture();

    [[nodiscard]] const ImageView& view() const { return view_; }
    /// Each read must lie between beginRead() and endRead(), because the CPU's caches may not be
    /// coherent with the camera.
    void beginRead() const;
    void endRead() const;

private:
    struct File {
        libcamera::SharedFD fd;
        std::size_t length = 0;
        void* memory = nullptr;
    };

    File& fileOf(const libcamera::SharedFD& fd);
    void map(const libcamera::FrameBuffer& buffer);
    void unmap();
    void synchronize(std::uint64_t flags) const;

    void share();

    std::vector<File> files_;
    ImageView view_;
    SharedMemory shared_;
};

}  // namespace mfar
