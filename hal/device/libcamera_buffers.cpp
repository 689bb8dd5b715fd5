#include "hal/device/libcamera_buffers.h"

#include <fmt/format.h>

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <system_error>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>

namespace mfar {

MappedPicture::MappedPicture(const libcamera::FrameBuffer& buffer, const PictureLayout& layout) {
    try {
        map(buffer);
        std::vector<PlaneBytes> planes;
        for (const auto& plane : buffer.planes()) {
            const auto* memory = static_cast<const std::uint8_t*>(fileOf(plane.fd).memory);
            planes.push_back({memory + plane.offset, plane.length});
        }
        view_ = layOut(layout, planes);
        share();
    } catch (...) {
        unmap();
        throw;
    }
}

MappedPicture::~MappedPicture() {
    unmap();
}

MappedPicture::File& MappedPicture::fileOf(const libcamera::SharedFD& fd) {
    const auto known =
        std::ranges::find_if(files_, [&](const File& file) { return file.fd.get() == fd.get(); });
    return known != files_.end() ? *known : files_.emplace_back(File{fd, 0, nullptr});
}

void MappedPicture::map(const libcamera::FrameBuffer& buffer) {
    for (const auto& plane : buffer.planes()) {
        File& file = fileOf(plane.fd);
        file.length = std::max(file.length, std::size_t{plane.offset} + plane.length);
    }
    for (File& file : files_) {
        void* memory = mmap(nullptr, file.length, PROT_READ, MAP_SHARED, file.fd.get(), 0);
        if (memory == MAP_FAILED)
            throw std::runtime_error(fmt::format("a camera's buffer cannot be mapped: {}",
                                                 std::generic_category().message(errno)));
        file.memory = memory;
    }
}

// A plane may begin anywhere in one of the camera's dma-bufs, so dma-buf and offset of each plane
// are computed from its address.
void MappedPicture::share() {
    shared_.id = newSharedMemoryId();
    const std::array<const std::uint8_t*, 3> begins{view_.data, view_.chroma[0].data,
                                                    view_.chroma[1].data};
    for (std::size_t i = 0; i < begins.size(); ++i)
        for (const File& file : files_) {
            const auto* memory = static_cast<const std::uint8_t*>(file.memory);
            if (begins[i] != nullptr && begins[i] >= memory && begins[i] < memory + file.length)
                shared_.planes[i] = {file.fd.get(), static_cast<std::size_t>(begins[i] - memory)};
        }
    view_.shared = &shared_;
}

void MappedPicture::unmap() {
    for (const File& file : files_)
        if (file.memory) munmap(file.memory, file.length);
    files_.clear();
}

void MappedPicture::beginRead() const {
    synchronize(DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ);
}

void MappedPicture::endRead() const {
    synchronize(DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
}

void MappedPicture::synchronize(std::uint64_t flags) const {
    const dma_buf_sync sync{flags};
    // The call fails for memory that is not a dma-buf. Such memory needs no synchronisation.
    for (const File& file : files_)
        ioctl(file.fd.get(), DMA_BUF_IOCTL_SYNC, &sync);
}

}  // namespace mfar
