#include "hal/device/v4l2_stream.h"

#include "hal/camera.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <utility>

namespace mfar {

struct V4l2Stream::Argument {
    v4l2_buffer buffer{};
    std::array<v4l2_plane, VIDEO_MAX_PLANES> planes{};

    Argument(std::uint32_t type, int index) {
        buffer.type = type;
        buffer.memory = V4L2_MEMORY_MMAP;
        buffer.index = static_cast<std::uint32_t>(index);
        if (multi()) {
            buffer.m.planes = planes.data();
            buffer.length = static_cast<std::uint32_t>(planes.size());
        }
    }
    Argument(const Argument&) = delete;
    Argument& operator=(const Argument&) = delete;

    [[nodiscard]] bool multi() const { return buffer.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }
};

V4l2Stream::V4l2Stream(V4l2Device device, const V4l2Layout& layout, int buffers)
    : device_(std::move(device)), type_(bufferType(*device_)), pieces_(layout.memoryPlanes),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (wake_.get() < 0)
        throw std::runtime_error("eventfd() failed: too many open files or no memory");
    allocate(buffers);
    returned_.reserve(buffers_.size());
    for (int i = 0; i < static_cast<int>(buffers_.size()); ++i) {
        mapBuffer(i);
        for (int p = 0; p < pieces_; ++p)
            if (memoryBytes(i, p) < layout.bytes[static_cast<std::size_t>(p)])
                throw std::runtime_error(fmt::format(
                    "{}: the driver's buffers have {} bytes, but a picture needs {}",
                    device_->path(), memoryBytes(i, p), layout.bytes[static_cast<std::size_t>(p)]));
        exportBuffer(i, layout);
    }
}

void V4l2Stream::allocate(int buffers) {
    constexpr std::uint32_t kMost = 64;
    v4l2_requestbuffers request{};
    auto count = static_cast<std::uint32_t>(std::clamp(buffers, 2, 32));
    int error = ENOMEM;
    // The driver may not have enough memory for all buffers, so after ENOMEM, fewer buffers are
    // requested.
    for (; error == ENOMEM && count > 0; --count) {
        request = {};
        request.type = type_;
        request.memory = V4L2_MEMORY_MMAP;
        request.count = count;
        error = device_->tryCall(VIDIOC_REQBUFS, &request);
    }
    if (error != 0) device_->fail("allocating buffers", error);
    if (request.count < 1 || request.count > kMost)
        throw std::runtime_error(
            fmt::format("{}: the driver allocated {} buffers, which is an invalid number",
                        device_->path(), request.count));
    buffers_.resize(request.count);
}

void V4l2Stream::mapBuffer(int index) {
    Argument argument(type_, index);
    device_->call(VIDIOC_QUERYBUF, &argument.buffer, "querying a buffer");
    const std::uint32_t clock = argument.buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK;
    if (clock != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
        throw std::runtime_error(
            fmt::format("{}: the driver's timestamps do not use CLOCK_MONOTONIC", device_->path()));
    for (int p = 0; p < pieces_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        const bool multi = argument.multi();
        const std::size_t length = multi ? argument.planes[i].length : argument.buffer.length;
        const std::int64_t offset =
            multi ? argument.planes[i].m.mem_offset : argument.buffer.m.offset;
        buffers_[static_cast<std::size_t>(index)].pieces[i] = device_->map(length, offset);
    }
}

// Exports the memory of a buffer as dma-bufs. If the driver does not support this, pictures are
// uploaded to the GPU instead.
void V4l2Stream::exportBuffer(int index, const V4l2Layout& layout) {
    if (layout.format.jpeg) return;
    Buffer& buffer = buffers_[static_cast<std::size_t>(index)];
    for (int p = 0; p < pieces_; ++p) {
        v4l2_exportbuffer request{};
        request.type = type_;
        request.index = static_cast<std::uint32_t>(index);
        request.plane = static_cast<std::uint32_t>(p);
        request.flags = O_CLOEXEC;
        if (device_->tryCall(VIDIOC_EXPBUF, &request) != 0) return;
        buffer.exported[static_cast<std::size_t>(p)] = OwnedFd(request.fd);
    }
    buffer.shared.id = newSharedMemoryId();
    for (std::size_t i = 0; i < layout.planes.size(); ++i) {
        const V4l2Layout::Plane& plane = layout.planes[i];
        buffer.shared.planes[i] = {buffer.exported[static_cast<std::size_t>(plane.memory)].get(),
                                   plane.offset};
    }
}

const SharedMemory* V4l2Stream::shared(int index) const {
    const Buffer& buffer = buffers_[static_cast<std::size_t>(index)];
    return buffer.shared.id != 0 ? &buffer.shared : nullptr;
}

int V4l2Stream::queue(int index) noexcept {
    Argument argument(type_, index);
    const int error = device_->tryCall(VIDIOC_QBUF, &argument.buffer);
    buffers_[static_cast<std::size_t>(index)].holder = error == 0 ? Holder::Driver : Holder::Nobody;
    return error;
}

void V4l2Stream::start() {
    const std::scoped_lock lock(mutex_);
    if (running_) return;
    for (const int index : takeReturned())
        buffers_[static_cast<std::size_t>(index)].holder = Holder::Nobody;
    for (std::size_t i = 0; i < buffers_.size(); ++i)
        if (buffers_[i].holder == Holder::Nobody)
            if (const int error = queue(static_cast<int>(i)))
                device_->fail("queueing a buffer", error);
    device_->call(VIDIOC_STREAMON, &type_, "starting");
    running_ = true;
}

void V4l2Stream::stop() noexcept {
    const std::scoped_lock lock(mutex_);
    if (!device_) return;
    static_cast<void>(device_->tryCall(VIDIOC_STREAMOFF, &type_));
    running_ = false;
    for (Buffer& buffer : buffers_)
        if (buffer.holder == Holder::Driver) buffer.holder = Holder::Nobody;
}

void V4l2Stream::close() noexcept {
    stop();
    const std::scoped_lock lock(mutex_);
    if (!device_) return;
    // Frees the driver's buffers. Otherwise, pictures whose memory is still mapped would keep the
    // device busy.
    v4l2_requestbuffers none{};
    none.type = type_;
    none.memory = V4L2_MEMORY_MMAP;
    static_cast<void>(device_->tryCall(VIDIOC_REQBUFS, &none));
    device_.reset();
    const std::scoped_lock returnedLock(returnedMutex_);
    wake_ = OwnedFd();
}

std::optional<V4l2Filled> V4l2Stream::take() {
    const std::scoped_lock lock(mutex_);
    if (!running_) return std::nullopt;
    Argument argument(type_, 0);
    const v4l2_buffer& buffer = argument.buffer;
    if (const int error = device_->tryCall(VIDIOC_DQBUF, &argument.buffer)) {
        if (error == EAGAIN) return std::nullopt;
        // EIO also means that the device is lost. Errors from which drivers recover are reported
        // with a flag of the buffer.
        throw DeviceLost(fmt::format("{}: the camera has stopped delivering pictures ({})",
                                     device_->path(), std::generic_category().message(error)));
    }
    if (buffer.index >= buffers_.size() || buffers_[buffer.index].holder != Holder::Driver)
        throw DeviceLost(fmt::format("{}: the driver returned buffer {}, which was not queued",
                                     device_->path(), buffer.index));
    buffers_[buffer.index].holder = Holder::Picture;
    V4l2Filled out{static_cast<int>(buffer.index), buffer.flags, buffer.sequence,
                   buffer.timestamp.tv_sec, buffer.timestamp.tv_usec};
    for (std::size_t i = 0; i < static_cast<std::size_t>(pieces_); ++i) {
        const v4l2_plane& plane = argument.planes[i];
        out.offset[i] = argument.multi() ? plane.data_offset : 0;
        out.bytes[i] = argument.multi() ? plane.bytesused : buffer.bytesused;
    }
    return out;
}

void V4l2Stream::giveBack(int index) noexcept {
    const std::scoped_lock lock(returnedMutex_);
    returned_.push_back(index);
    constexpr std::uint64_t kOne = 1;
    if (wake_.get() >= 0) static_cast<void>(!write(wake_.get(), &kOne, sizeof kOne));
}

std::vector<int> V4l2Stream::takeReturned() noexcept {
    const std::scoped_lock lock(returnedMutex_);
    std::uint64_t drained = 0;
    static_cast<void>(!read(wake_.get(), &drained, sizeof drained));
    std::vector<int> out = returned_;
    returned_.clear();
    return out;
}

void V4l2Stream::takeBack() noexcept {
    const std::scoped_lock lock(mutex_);
    for (const int index : takeReturned()) {
        if (running_)
            // An error is ignored here: if the device is lost, the next take() throws.
            static_cast<void>(queue(index));
        else
            buffers_[static_cast<std::size_t>(index)].holder = Holder::Nobody;
    }
}

std::array<const std::uint8_t*, 3> V4l2Stream::memory(int index) const {
    const auto& pieces = buffers_[static_cast<std::size_t>(index)].pieces;
    return {pieces[0].get(), pieces[1].get(), pieces[2].get()};
}

std::size_t V4l2Stream::memoryBytes(int index, int piece) const {
    return buffers_[static_cast<std::size_t>(index)]
        .pieces[static_cast<std::size_t>(piece)]
        .get_deleter()
        .length;
}

}  // namespace mfar
