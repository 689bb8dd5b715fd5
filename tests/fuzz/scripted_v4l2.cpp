#include "tests/fuzz/scripted_v4l2.h"

#include "base/time.h"

#include <linux/videodev2.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace mfar::test {
namespace {

constexpr std::size_t kMostMemory = 1 << 20;
constexpr std::array kErrors{EINVAL, ENODEV, EAGAIN, EBUSY, ENOMEM, EACCES, ERANGE, EIO};

bool isBuffer(unsigned long request) {
    return request == VIDIOC_QUERYBUF || request == VIDIOC_QBUF || request == VIDIOC_DQBUF;
}

int soundFormat(v4l2_format& format) {
    if (format.type != V4L2_BUF_TYPE_VIDEO_CAPTURE) return EINVAL;
    format.fmt.pix.bytesperline = 2 * format.fmt.pix.width;
    format.fmt.pix.sizeimage = format.fmt.pix.bytesperline * format.fmt.pix.height;
    return 0;
}

int soundControl(v4l2_query_ext_ctrl& control) {
    const std::uint32_t after =
        control.id & ~(V4L2_CTRL_FLAG_NEXT_CTRL | V4L2_CTRL_FLAG_NEXT_COMPOUND);
    if (after >= 2) return EINVAL;
    control = {};
    control.id = after + 1;
    control.type = after == 0 ? V4L2_CTRL_TYPE_INTEGER : V4L2_CTRL_TYPE_MENU;
    control.maximum = after == 0 ? 9 : 2;
    control.step = 1;
    std::strcpy(control.name, after == 0 ? "Gain" : "Mode");
    return 0;
}

}  // namespace

int ScriptedV4l2::open(const char* /*path*/) {
    return eventfd(1, EFD_CLOEXEC | EFD_NONBLOCK);  // always readable, as if a picture has arrived
}

std::uint8_t ScriptedV4l2::next() {
    if (script_.empty()) return 8;
    const std::uint8_t out = script_.front();
    script_ = script_.subspan(1);
    return out;
}

void ScriptedV4l2::fill(void* to, std::size_t bytes) {
    const std::size_t count = std::min(bytes, script_.size());
    std::memcpy(to, script_.data(), count);
    script_ = script_.subspan(count);
}

int ScriptedV4l2::ioctl(int /*fd*/, unsigned long request, void* argument) {
    const std::uint8_t choice = next();
    constexpr std::uint8_t kHostile = 128;
    int error = 0;
    if (choice < kErrors.size())
        error = kErrors[choice];
    else
        error = choice < kHostile ? sound(request, argument) : hostile(request, argument);
    errno = error;
    return error == 0 ? 0 : -1;
}

int ScriptedV4l2::sound(unsigned long request, void* argument) {
    switch (request) {
    case VIDIOC_QUERYCAP: {
        auto& about = *static_cast<v4l2_capability*>(argument);
        about.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
    }
    case VIDIOC_ENUM_FMT: {
        auto& format = *static_cast<v4l2_fmtdesc*>(argument);
        format.pixelformat = format.index == 0 ? V4L2_PIX_FMT_YUYV : V4L2_PIX_FMT_MJPEG;
        return format.index < 2 ? 0 : EINVAL;
    }
    case VIDIOC_ENUM_FRAMESIZES: {
        auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
        size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        size.discrete = {64, 48};
        return size.index == 0 ? 0 : EINVAL;
    }
    case VIDIOC_S_FMT: return soundFormat(*static_cast<v4l2_format*>(argument));
    case VIDIOC_QUERY_EXT_CTRL: return soundControl(*static_cast<v4l2_query_ext_ctrl*>(argument));
    case VIDIOC_QUERYMENU:
        std::memcpy(static_cast<v4l2_querymenu*>(argument)->name, "manual", 7);
        return 0;
    case VIDIOC_QUERYBUF:
        static_cast<v4l2_buffer*>(argument)->flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
        static_cast<v4l2_buffer*>(argument)->length = 64 * 48 * 2;
        return 0;
    case VIDIOC_DQBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        const Timestamp now = Timestamp::now();
        buffer.index = filled_++ % 3;
        buffer.bytesused = 64 * 48 * 2;
        buffer.timestamp = {now.ns / 1'000'000'000, now.ns / 1000 % 1'000'000};
        return 0;
    }
    case VIDIOC_ENUM_FRAMEINTERVALS:
    case VIDIOC_EXPBUF: return EINVAL;
    default: return 0;
    }
}

int ScriptedV4l2::hostile(unsigned long request, void* argument) {
    if (request == VIDIOC_EXPBUF) {
        static_cast<v4l2_exportbuffer*>(argument)->fd = eventfd(0, EFD_CLOEXEC);
        return 0;
    }
    if (request == VIDIOC_G_EXT_CTRLS || request == VIDIOC_S_EXT_CTRLS) {
        auto& controls = *static_cast<v4l2_ext_controls*>(argument);
        if (controls.count == 1) fill(&controls.controls->value64, sizeof(std::int64_t));
        return 0;
    }
    if ((_IOC_DIR(request) & _IOC_READ) == 0) return 0;
    if (!isBuffer(request)) {
        fill(argument, _IOC_SIZE(request));
        return 0;
    }
    auto& buffer = *static_cast<v4l2_buffer*>(argument);
    const v4l2_buffer before = buffer;
    fill(&buffer, sizeof buffer);
    buffer.type = before.type;
    if (before.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE) {
        buffer.m = before.m;
        buffer.length = before.length;
        fill(buffer.m.planes, sizeof(v4l2_plane) * buffer.length);
    }
    return 0;
}

void* ScriptedV4l2::map(int /*fd*/, std::size_t length, std::int64_t /*offset*/) {
    if (length == 0 || length > kMostMemory) {
        errno = EINVAL;
        return MAP_FAILED;
    }
    return mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

}  // namespace mfar::test
