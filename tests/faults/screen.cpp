#include "tests/device/pretended_picture.h"
#include "tests/faults/board.h"
#include "tests/faults/judge.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <span>
#include <string>
#include <thread>

namespace mfar::faults {
namespace {

class Reader {
public:
    void add(std::span<const char> bytes) {
        text_.append(bytes.begin(), bytes.end());
        while (takeHeader() || takePicture()) {
        }
        if (at_ > kMost) {
            text_.erase(0, at_);
            at_ = 0;
        }
    }

private:
    static constexpr std::size_t kMost = 1U << 16U;
    static constexpr std::string_view kFrame = "FRAME\n";

    bool takeHeader() {
        const std::size_t end = text_.find('\n', at_);
        if (width_ > 0 || end == text_.npos) return false;
        if (std::sscanf(text_.c_str() + at_, "YUV4MPEG2 W%d H%d", &width_, &height_) != 2)
            Judge::get().fail("the screen receives no valid video header");
        at_ = end + 1;
        return true;
    }
    bool takePicture() {
        const std::size_t luma =
            static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
        const std::size_t whole = kFrame.size() + luma + luma / 2;
        if (width_ == 0 || text_.size() < at_ + whole) return false;
        if (text_.compare(at_, kFrame.size(), kFrame) != 0)
            Judge::get().fail("the screen receives no valid picture");
        const auto* pixels =
            reinterpret_cast<const std::uint8_t*>(text_.data()) + at_ + kFrame.size();
        at_ += whole;
        if (const auto ms = pretended::stampOf({pixels, luma}, width_)) {
            // The stamp contains only the lower bits of the time. The picture's time is the latest
            // time up to now that has these lower bits.
            const std::int64_t now = Scheduler::get().now() / kMs;
            constexpr std::int64_t kMask = (1LL << pretended::kStampBits) - 1;
            Judge::get().shows((now - ((now - *ms) & kMask)) * kMs);
        } else {
            ++unread_;
            if (unread_ == 1) Judge::get().note("a picture on the screen has no valid time stamp");
        }
        return true;
    }

    std::string text_;
    std::size_t at_ = 0;
    int width_ = 0, height_ = 0;
    std::uint64_t unread_ = 0;
};

}  // namespace

void runScreen() {
    const int fd = open(Board::kPipe, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    Reader reader;
    std::string bytes(1U << 16U, '\0');
    for (;;) {
        pollfd readable{fd, POLLIN, 0};
        poll(&readable, 1, -1);
        while (Board::get().readerStalls())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        const ssize_t count = read(fd, bytes.data(), bytes.size());
        if (count > 0) reader.add({bytes.data(), static_cast<std::size_t>(count)});
        // The pipe has no writer before mfard opens it and after mfard closes it.
        if (count <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

}  // namespace mfar::faults
