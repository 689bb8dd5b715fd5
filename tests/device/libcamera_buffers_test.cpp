#include "hal/device/libcamera_buffers.h"

#include <gtest/gtest.h>

#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

using libcamera::FrameBuffer;
using Planes = std::vector<FrameBuffer::Plane>;

libcamera::SharedFD memory(std::uint8_t first) {
    libcamera::SharedFD fd(memfd_create("picture", 0));
    for (unsigned i = 0; i < 4096; ++i) {
        const auto byte = static_cast<std::uint8_t>(first + i);
        if (pwrite(fd.get(), &byte, 1, i) != 1) throw std::runtime_error("pwrite failed");
    }
    return fd;
}

FrameBuffer::Plane plane(const libcamera::SharedFD& fd, unsigned offset, unsigned length) {
    FrameBuffer::Plane plane;
    plane.fd = fd;
    plane.offset = offset;
    plane.length = length;
    return plane;
}

TEST(MappedPicture, PlanesMayLieAtDifferentOffsetsOfOneFile) {
    const auto fd = memory(0);
    const FrameBuffer buffer(Planes{plane(fd, 16, 32 * 16), plane(fd, 1000, 32 * 8)});
    const MappedPicture picture(buffer, {{32, 16}, PixelFormat::Nv12, 32});
    EXPECT_EQ(picture.view().data[0], 16);
    EXPECT_EQ(picture.view().chroma[0].data[0], 1000 % 256);
}

TEST(MappedPicture, EachPlaneMayHaveItsOwnFile) {
    const FrameBuffer buffer(Planes{plane(memory(1), 0, 32 * 16), plane(memory(2), 0, 16 * 8),
                                    plane(memory(3), 0, 16 * 8)});
    const MappedPicture picture(buffer, {{32, 16}, PixelFormat::Yuv420, 32});
    EXPECT_EQ(picture.view().data[0], 1);
    EXPECT_EQ(picture.view().chroma[0].data[0], 2);
    EXPECT_EQ(picture.view().chroma[1].data[0], 3);
}

TEST(MappedPicture, APictureOutlivesItsBufferAndCanBeReadWithoutADmaBuf) {
    std::unique_ptr<MappedPicture> picture;
    {
        const FrameBuffer buffer(Planes{plane(memory(7), 0, 4096)});
        picture =
            std::make_unique<MappedPicture>(buffer, PictureLayout{{32, 16}, PixelFormat::Yuyv, 64});
    }
    picture->beginRead();  // has no effect, because this memory is not a dma-buf
    EXPECT_EQ(picture->view().data[64], 7 + 64);
    picture->endRead();
}

TEST(MappedPicture, TooSmallMemoryIsRefused) {
    const auto fd = memory(0);
    const PictureLayout layout{{32, 16}, PixelFormat::Nv12, 32};
    const FrameBuffer small(Planes{plane(fd, 0, 32 * 16), plane(fd, 512, 32 * 7)});
    EXPECT_THROW(MappedPicture(small, layout), std::runtime_error);
    const FrameBuffer closed(Planes{plane(libcamera::SharedFD(), 0, 4096)});
    EXPECT_THROW(MappedPicture(closed, layout), std::runtime_error);
}

}  // namespace
}  // namespace mfar
