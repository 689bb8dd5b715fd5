#include "tests/device/fake_v4l2.h"

#include "base/time.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace mfar::test {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::size_t kPieces = 3 * 16;

int bytesAPixel(std::uint32_t fourcc) {
    if (fourcc == V4L2_PIX_FMT_YUYV) return 2;
    return fourcc == V4L2_PIX_FMT_XBGR32 ? 4 : 1;
}

}  // namespace

void putText(void* field, std::size_t bytes, const std::string& text) {
    std::memset(field, 0, bytes);
    std::memcpy(field, text.data(), std::min(text.size(), bytes));
}

FakeV4l2::FakeV4l2() : memory_(memfd_create("fake", MFD_CLOEXEC)) {
    static_cast<void>(ftruncate(memory_, kPiece * kPieces) == 0);
    bytes_ = static_cast<std::uint8_t*>(
        mmap(nullptr, kPiece * kPieces, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0));
}

FakeV4l2::~FakeV4l2() {
    if (pictureEnd_ >= 0) close(pictureEnd_);
    munmap(bytes_, kPiece * kPieces);
    close(memory_);
}

std::vector<std::string> FakeV4l2::nodes() {
    std::vector<std::string> out{"/dev/video0", "/dev/video1"};
    if (!secondPath.empty()) out.push_back(secondPath);
    return out;
}

int FakeV4l2::open(const char* path) {
    const std::scoped_lock lock(mutex_);
    const auto all = nodes();
    if (gone_ || std::find(all.begin(), all.end(), path) == all.end()) {
        errno = ENOENT;
        return -1;
    }
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return -1;
    plain_.erase(ends[0]);
    if (std::string(path) == "/dev/video1") {
        plain_.insert(ends[0]);
        close(ends[1]);
        return ends[0];
    }
    if (pictureEnd_ >= 0) close(pictureEnd_);
    pictureEnd_ = ends[1];
    readEnd_ = ends[0];
    return ends[0];
}

int FakeV4l2::ioctl(int fd, unsigned long request, void* argument) {
    if (request == VIDIOC_DQBUF || request == VIDIOC_QBUF || request == VIDIOC_STREAMOFF) {
        std::unique_lock lock(hangMutex_);
        ++inside_;
        mayGoOn_.wait(lock, [&] { return !hanging_; });
        --inside_;
    }
    const std::scoped_lock lock(mutex_);
    int error = gone_ ? ENODEV : 0;
    if (error == 0 && request == VIDIOC_QUERYCAP) {
        auto& about = *static_cast<v4l2_capability*>(argument);
        putText(about.card, sizeof about.card, card);
        putText(about.bus_info, sizeof about.bus_info, "fake:1");
        about.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        const std::uint32_t kind =
            multiPlanar ? V4L2_CAP_VIDEO_CAPTURE_MPLANE : V4L2_CAP_VIDEO_CAPTURE;
        about.device_caps = V4L2_CAP_STREAMING |
                            (plain_.contains(fd) ? std::uint32_t{V4L2_CAP_META_CAPTURE} : kind);
        return 0;
    }
    if (error == 0) error = answer(request, argument);
    errno = error;
    return error == 0 ? 0 : -1;
}

void* FakeV4l2::map(int, std::size_t length, std::int64_t offset) {
    return mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, offset);
}

int FakeV4l2::answer(unsigned long request, void* argument) {
    switch (request) {
    case VIDIOC_ENUM_FMT:
    case VIDIOC_ENUM_FRAMESIZES:
    case VIDIOC_ENUM_FRAMEINTERVALS: return list(request, argument);
    case VIDIOC_QUERY_EXT_CTRL:
    case VIDIOC_QUERYMENU:
    case VIDIOC_G_EXT_CTRLS:
    case VIDIOC_S_EXT_CTRLS: return knobs(request, argument);
    case VIDIOC_ENUMINPUT: return hasInput ? 0 : ENOTTY;
    case VIDIOC_S_FMT: return setFormat(*static_cast<v4l2_format*>(argument));
    case VIDIOC_G_PARM:
    case VIDIOC_S_PARM: {
        auto& capture = static_cast<v4l2_streamparm*>(argument)->parm.capture;
        const auto& wanted = capture.timeperframe;
        const FakeFormat* format = find(fourcc_);
        if (request == VIDIOC_S_PARM && format != nullptr && wanted.numerator > 0) {
            const double rate =
                std::min(format->fastest, double(wanted.denominator) / wanted.numerator);
            interval_ = {100, static_cast<std::uint32_t>(std::lround(100 * rate))};
        }
        capture.capability = V4L2_CAP_TIMEPERFRAME;
        capture.timeperframe = interval_;
        return 0;
    }
    default: return stream(request, argument);
    }
}

const FakeFormat* FakeV4l2::find(std::uint32_t fourcc) const {
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const FakeFormat& f) { return f.fourcc == fourcc; });
    return found == formats.end() ? nullptr : &*found;
}

int FakeV4l2::list(unsigned long request, void* argument) {
    if (request == VIDIOC_ENUM_FMT) {
        auto& query = *static_cast<v4l2_fmtdesc*>(argument);
        if (query.index >= formats.size()) return EINVAL;
        query.pixelformat = formats[query.index].fourcc;
        return 0;
    }
    if (request == VIDIOC_ENUM_FRAMESIZES) {
        auto& query = *static_cast<v4l2_frmsizeenum*>(argument);
        const FakeFormat* format = find(query.pixel_format);
        if (format == nullptr || query.index >= format->sizes.size()) return EINVAL;
        const Size size = format->sizes[query.index];
        query.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        query.discrete = {static_cast<std::uint32_t>(size.width),
                          static_cast<std::uint32_t>(size.height)};
        return 0;
    }
    auto& query = *static_cast<v4l2_frmivalenum*>(argument);
    const FakeFormat* format = find(query.pixel_format);
    if (format == nullptr || query.index > 0) return EINVAL;
    query.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    query.discrete = {100, static_cast<std::uint32_t>(std::lround(100 * format->fastest))};
    return 0;
}

std::vector<std::size_t> FakeV4l2::planeBytes() const {
    const std::size_t row = size_.width * bytesAPixel(fourcc_) + padding;
    const std::size_t luma = row * size_.height;
    if (fourcc_ == V4L2_PIX_FMT_NV12M) return {luma, luma / 2};
    const bool shared = fourcc_ == V4L2_PIX_FMT_NV12 || fourcc_ == V4L2_PIX_FMT_YUV420;
    if (fourcc_ == V4L2_PIX_FMT_MJPEG) return {std::size_t{8192}};
    return {shared ? luma + luma / 2 : luma};
}

int FakeV4l2::setFormat(v4l2_format& format) {
    if (busy || !buffers_.empty()) return EBUSY;
    auto& single = format.fmt.pix;
    auto& multi = format.fmt.pix_mp;
    fourcc_ = multiPlanar ? multi.pixelformat : single.pixelformat;
    if (find(fourcc_) == nullptr) fourcc_ = formats.front().fourcc;
    size_ = multiPlanar ? Size{static_cast<int>(multi.width), static_cast<int>(multi.height)}
                        : Size{static_cast<int>(single.width), static_cast<int>(single.height)};
    if (rounds) size_ = {16, 16};
    const auto width = static_cast<std::uint32_t>(size_.width);
    const auto height = static_cast<std::uint32_t>(size_.height);
    const bool jpeg = fourcc_ == V4L2_PIX_FMT_MJPEG;
    const auto row = static_cast<std::uint32_t>(
        jpeg ? 0 : size_.width * bytesAPixel(fourcc_) + static_cast<int>(padding));
    const auto planes = planeBytes();
    if (!multiPlanar) {
        single.width = width;
        single.height = height;
        single.pixelformat = fourcc_;
        single.bytesperline = row;
        single.sizeimage = static_cast<std::uint32_t>(static_cast<int>(planes[0]) + sizeFault);
        single.colorspace = colorspace;
        single.quantization = quantization;
        return 0;
    }
    multi.width = width;
    multi.height = height;
    multi.pixelformat = fourcc_;
    multi.colorspace = colorspace;
    multi.quantization = static_cast<std::uint8_t>(quantization);
    multi.num_planes = static_cast<std::uint8_t>(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        multi.plane_fmt[i].bytesperline = row;
        multi.plane_fmt[i].sizeimage = static_cast<std::uint32_t>(planes[i]);
    }
    return 0;
}

int FakeV4l2::requestBuffers(v4l2_requestbuffers& request) {
    if (running_ || busy) return EBUSY;
    buffers_.clear();
    released_ = request.count == 0;
    if (refusesMore && request.count > mostBuffers) return ENOMEM;
    request.count = std::min(request.count, mostBuffers);
    buffers_.resize(request.count);
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        Buffer& b = buffers_[i];
        b.said.index = static_cast<std::uint32_t>(i);
        b.said.flags = clock;
        const auto bytes = planeBytes();
        b.planes.resize(bytes.size());
        for (std::size_t p = 0; p < bytes.size(); ++p) {
            b.planes[p].length = static_cast<std::uint32_t>(bytes[p]) + dataOffset;
            b.planes[p].m.mem_offset = static_cast<std::uint32_t>(kPiece * (3 * i + p));
        }
    }
    return 0;
}

int FakeV4l2::say(v4l2_buffer& to, int index) {
    const Buffer& b = buffers_[static_cast<std::size_t>(index)];
    v4l2_plane* const planes = to.m.planes;
    const std::uint32_t room = to.length, type = to.type;
    to = b.said;
    to.type = type;
    if (!multiPlanar) {
        to.length = b.planes[0].length;
        to.bytesused = b.planes[0].bytesused;
        to.m.offset = b.planes[0].m.mem_offset;
        return 0;
    }
    if (room < b.planes.size()) return EINVAL;
    std::copy(b.planes.begin(), b.planes.end(), planes);
    to.m.planes = planes;
    to.length = static_cast<std::uint32_t>(b.planes.size());
    return 0;
}

void FakeV4l2::drain(std::size_t pictures) const {
    char byte = 0;
    while (pictures-- > 0)
        static_cast<void>(read(readEnd_, &byte, 1) == 1);
}

int FakeV4l2::dequeue(v4l2_buffer& to) {
    if (!running_) return EINVAL;
    if (done_.empty()) return EAGAIN;
    const int index = done_.front();
    done_.erase(done_.begin());
    buffers_[static_cast<std::size_t>(index)].done = false;
    drain(1);
    return say(to, index);
}

int FakeV4l2::stream(unsigned long request, void* argument) {
    auto& buffer = *static_cast<v4l2_buffer*>(argument);
    switch (request) {
    case VIDIOC_REQBUFS: return requestBuffers(*static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF:
        return buffer.index < buffers_.size() ? say(buffer, static_cast<int>(buffer.index))
                                              : EINVAL;
    case VIDIOC_QBUF: {
        if (buffer.index >= buffers_.size()) return EINVAL;
        Buffer& b = buffers_[buffer.index];
        if (b.queued || b.done) return EINVAL;
        b.queued = true;
        return 0;
    }
    case VIDIOC_DQBUF: return dequeue(buffer);
    case VIDIOC_STREAMON: running_ = true; return 0;
    case VIDIOC_STREAMOFF:
        running_ = false;
        drain(done_.size());
        done_.clear();
        for (Buffer& b : buffers_)
            b.queued = b.done = false;
        return 0;
    default: return ENOTTY;
    }
}

bool FakeV4l2::deliver(const FakePicture& picture) {
    const std::scoped_lock lock(mutex_);
    sequence_ += static_cast<std::uint32_t>(picture.skipped);
    const auto next =
        std::find_if(buffers_.begin(), buffers_.end(), [](const Buffer& b) { return b.queued; });
    const std::uint32_t number = sequence_++;
    if (!running_ || next == buffers_.end()) return false;
    next->queued = false;
    next->done = true;
    next->said.sequence = number;
    next->said.flags = clock | picture.flags;
    const std::int64_t ns = Timestamp::now().ns - picture.ageMs * 1'000'000;
    next->said.timestamp.tv_sec = ns / 1'000'000'000;
    next->said.timestamp.tv_usec = ns % 1'000'000'000 / 1000;
    for (v4l2_plane& plane : next->planes) {
        std::uint8_t* to = bytes_ + plane.m.mem_offset;
        std::memset(to, 0, dataOffset);
        std::memset(to + dataOffset, picture.level, plane.length - dataOffset);
        plane.data_offset = dataOffset;
        plane.bytesused = static_cast<std::uint32_t>(plane.length - picture.missingBytes);
        if (picture.jpeg.empty()) continue;
        std::copy(picture.jpeg.begin(), picture.jpeg.end(), to);
        plane.bytesused = static_cast<std::uint32_t>(picture.jpeg.size());
    }
    done_.push_back(static_cast<int>(next->said.index));
    return write(pictureEnd_, "x", 1) == 1;
}

void FakeV4l2::hang(bool wanted) {
    {
        const std::scoped_lock lock(hangMutex_);
        hanging_ = wanted;
    }
    mayGoOn_.notify_all();
}

bool FakeV4l2::hangs() {
    const std::scoped_lock lock(hangMutex_);
    return hanging_ && inside_ > 0;
}

void FakeV4l2::hangUp() {
    const std::scoped_lock lock(mutex_);
    close(pictureEnd_);
    pictureEnd_ = -1;
}

void FakeV4l2::unplug() {
    const std::scoped_lock lock(mutex_);
    gone_ = true;
    if (pictureEnd_ >= 0) close(pictureEnd_);
    pictureEnd_ = -1;
}

int FakeV4l2::queued() {
    const std::scoped_lock lock(mutex_);
    return static_cast<int>(
        std::count_if(buffers_.begin(), buffers_.end(), [](const Buffer& b) { return b.queued; }));
}

bool FakeV4l2::released() {
    const std::scoped_lock lock(mutex_);
    return released_;
}

std::int64_t FakeV4l2::control(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    for (const FakeControl& c : controls)
        if (c.name == name) return c.value;
    return -1;
}

}  // namespace mfar::test
