#pragma once

#include "tests/device/pretended_counts.h"
#include "tests/device/pretended_gpio.h"
#include "tests/device/pretended_picture.h"
#include "tests/device/pretended_words.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mfar::pretended {

using std::chrono::steady_clock;

inline void sleepMs(double ms) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
}

/// A V4L2 camera that is simulated inside the program that opens it. Words in a file select its
/// faults, see pretended_v4l2.cpp.
class Device {
public:
    Device(std::string file, std::string name)
        : words_(std::move(file)), name_(std::move(name)), plug_(words_.now()["unplug"]),
          fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)),
          memory_(memfd_create("pretended", MFD_CLOEXEC)) {}
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() {
        stop();
        close(memory_);
    }

    [[nodiscard]] int fd() const { return fd_; }
    [[nodiscard]] int memory() const { return memory_; }

    int open() const {
        if (fd_ < 0 || memory_ < 0) return EMFILE;
        waitWhile("hang-open");
        const Words wrong = words_.now();
        if (wrong.contains("slow")) sleepMs(wrong.at("slow"));
        setGain(0);
        return wrong.contains("gone") ? ENODEV : 0;
    }
    void waitWhile(const char* word) const {
        while (words_.now().contains(word))
            sleepMs(5);
    }

    int call(unsigned long request, void* argument) {
        if (request == VIDIOC_DQBUF || request == VIDIOC_QBUF || request == VIDIOC_STREAMOFF)
            waitWhile("hang");
        if (request == VIDIOC_DQBUF && words_.now()["unplug"] != plug_) return ENODEV;
        if (isLost_ && request != VIDIOC_STREAMOFF) return lostError_;
        switch (request) {
        case VIDIOC_QUERYCAP: return describe(*static_cast<v4l2_capability*>(argument));
        case VIDIOC_ENUMINPUT: return 0;
        case VIDIOC_ENUM_FMT: {
            auto& query = *static_cast<v4l2_fmtdesc*>(argument);
            query.pixelformat = V4L2_PIX_FMT_YUYV;
            return query.index == 0 ? 0 : EINVAL;
        }
        case VIDIOC_ENUM_FRAMESIZES: {
            auto& query = *static_cast<v4l2_frmsizeenum*>(argument);
            query.type = V4L2_FRMSIZE_TYPE_STEPWISE;
            query.stepwise = {16, 4096, 2, 16, 4096, 2};
            return query.index == 0 ? 0 : EINVAL;
        }
        case VIDIOC_G_PARM:
        case VIDIOC_S_PARM: return rate(request, *static_cast<v4l2_streamparm*>(argument));
        case VIDIOC_S_FMT: return setFormat(*static_cast<v4l2_format*>(argument));
        case VIDIOC_REQBUFS: return allocate(*static_cast<v4l2_requestbuffers*>(argument));
        case VIDIOC_QUERYBUF: return query(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_QBUF: return queue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_DQBUF: return dequeue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_STREAMON: return start();
        case VIDIOC_STREAMOFF: stop(); return 0;
        case VIDIOC_QUERY_EXT_CTRL: return describe(*static_cast<v4l2_query_ext_ctrl*>(argument));
        case VIDIOC_G_EXT_CTRLS:
        case VIDIOC_S_EXT_CTRLS:
            return gain(request, *static_cast<v4l2_ext_controls*>(argument)->controls);
        default: return ENOTTY;
        }
    }

private:
    int describe(v4l2_capability& about) const {
        about = {};
        std::strncpy(reinterpret_cast<char*>(about.card), name_.c_str(), sizeof about.card - 1);
        std::memcpy(about.bus_info, about.card, sizeof about.bus_info - 1);
        about.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        about.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
    }

    static int describe(v4l2_query_ext_ctrl& control) {
        constexpr std::uint32_t kNext = V4L2_CTRL_FLAG_NEXT_CTRL | V4L2_CTRL_FLAG_NEXT_COMPOUND;
        if ((control.id & ~kNext) >= V4L2_CID_GAIN) return EINVAL;
        control = {};
        control.id = V4L2_CID_GAIN;
        control.type = V4L2_CTRL_TYPE_INTEGER;
        std::strncpy(control.name, "Gain", sizeof control.name - 1);
        control.maximum = 255;
        control.step = 1;
        return 0;
    }
    int gain(unsigned long request, v4l2_ext_control& value) {
        if (value.id != V4L2_CID_GAIN) return EINVAL;
        const Words wrong = words_.now();
        if (request == VIDIOC_S_EXT_CTRLS) {
            if (wrong.contains("refuse") && refused_++ < wrong.at("refuse")) return EBUSY;
            setGain(value.value);
        }
        value.value = static_cast<std::int32_t>(Known::get().of(name_).gain);
        return 0;
    }
    void setGain(std::int64_t value) const { Known::get().setGain(name_, value); }

    int rate(unsigned long request, v4l2_streamparm& parameters) {
        auto& capture = parameters.parm.capture;
        const v4l2_fract asked = capture.timeperframe;
        if (request == VIDIOC_S_PARM && asked.numerator > 0 && asked.denominator > 0)
            rateHz_ = static_cast<double>(asked.denominator) / asked.numerator;
        capture.capability = V4L2_CAP_TIMEPERFRAME;
        capture.timeperframe = {1000, static_cast<std::uint32_t>(rateHz_ * 1000)};
        return 0;
    }

    int setFormat(v4l2_format& format) {
        auto& pix = format.fmt.pix;
        pix.pixelformat = V4L2_PIX_FMT_YUYV;
        pix.bytesperline = pix.width * 2;
        pix.sizeimage = pix.bytesperline * pix.height;
        bytes_ = pix.sizeimage;
        width_ = static_cast<int>(pix.width);
        return 0;
    }

    int allocate(v4l2_requestbuffers& request) {
        const std::lock_guard lock(mutex_);
        const Words wrong = words_.now();
        const auto most = wrong.contains("buffers") ? wrong.at("buffers") : 32;
        request.count = std::min(request.count, static_cast<std::uint32_t>(most));
        room_ = (bytes_ + 4095) / 4096 * 4096;
        buffers_.assign(request.count, {});
        const auto bytes = static_cast<off_t>(room_ * buffers_.size());
        if (bytes <= mapped_) return 0;
        mapped_ = bytes;
        return ftruncate(memory_, bytes) == 0 ? 0 : ENOMEM;
    }

    int query(v4l2_buffer& to) {
        const std::lock_guard lock(mutex_);
        if (to.index >= buffers_.size()) return EINVAL;
        to.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
        to.length = static_cast<std::uint32_t>(bytes_);
        to.m.offset = static_cast<std::uint32_t>(room_ * to.index);
        return 0;
    }

    int queue(v4l2_buffer& from) {
        const std::lock_guard lock(mutex_);
        if (from.index >= buffers_.size()) return EINVAL;
        free_.push_back(from.index);
        return 0;
    }

    int dequeue(v4l2_buffer& to) {
        const std::lock_guard lock(mutex_);
        if (filled_.empty()) return EAGAIN;
        to = buffers_[filled_.front()];
        filled_.pop_front();
        std::uint64_t one = 0;
        static_cast<void>(!read(fd_, &one, sizeof one));
        Known::get().add(name_, to, bytes_, lastGood_);
        return 0;
    }

    int start() {
        const std::lock_guard lock(mutex_);
        running_ = true;
        pulse_ = lastPulse();
        picture_.clear();
        maker_ = std::thread([this] { make(); });
        return 0;
    }

    void stop() {
        running_ = false;
        if (maker_.joinable()) maker_.join();
        const std::lock_guard lock(mutex_);
        free_.clear();
        for (; !filled_.empty(); filled_.pop_front()) {
            std::uint64_t one = 0;
            static_cast<void>(!read(fd_, &one, sizeof one));
        }
    }

    void awaitUntil(steady_clock::time_point due) const {
        while (running_ && steady_clock::now() < due)
            std::this_thread::sleep_for(std::min<steady_clock::duration>(
                due - steady_clock::now(), std::chrono::milliseconds(20)));
    }

    /// Waits for a pulse of the trigger line. Returns false after 100 ms without a pulse, so that
    /// the caller can read new faults.
    bool awaitPulse() {
        constexpr int kLooks = 20;
        for (int i = 0; i < kLooks && running_; ++i) {
            const std::int64_t before = std::exchange(pulse_, lastPulse().load());
            if (pulse_ != before) return true;
            sleepMs(5);
        }
        return false;
    }

    void make() {
        auto due = steady_clock::now();
        std::uint32_t number = 0;
        Words before;
        for (std::uint64_t i = 1; running_; ++i) {
            const Words wrong = words_.now();
            const double hz = wrong.contains("rate") ? wrong.at("rate") : rateHz_.load();
            const bool isTriggered = wrong.contains("triggered");
            if (!isTriggered) {
                due += std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / hz));
                awaitUntil(due);
            }
            const bool isDue = !isTriggered || awaitPulse();
            if (wrong.contains("gone") || wrong.contains("eio"))
                return lose(wrong.contains("gone") ? ENODEV : EIO);
            if (!isDue) continue;
            if (wrong.contains("skip") && !before.contains("skip"))
                number += static_cast<std::uint32_t>(wrong.at("skip"));
            if (wrong.contains("restart") && !before.contains("restart")) number = 0;
            const bool silent = wrong.contains("silent");
            const std::int64_t us = isTriggered ? pulse_ : microsecondsNow();
            if (!running_ || silent || fill(wrong, i, number, us)) ++number;
            before = wrong;
        }
    }

    /// Wakes a program that waits for pictures. From now on, all calls of the driver except
    /// VIDIOC_STREAMOFF fail with `error`.
    void lose(int error) {
        lostError_ = error;
        isLost_ = true;
        const std::uint64_t one = 1;
        static_cast<void>(!write(fd_, &one, sizeof one));
    }

    /// Fills a buffer with picture `i`. `us`: time of the picture [us]. Returns false if no buffer
    /// is free.
    bool fill(const Words& wrong, std::uint64_t i, std::uint32_t number, std::int64_t us) {
        const std::lock_guard lock(mutex_);
        if (free_.empty() || wrong.contains("hang")) return false;
        if (!wrong.contains("repeat") || picture_.empty()) {
            picture_.resize(bytes_);
            paint(picture_, i);
            if (!wrong.contains("plain")) stamp(picture_, width_, us / 1000);
        }
        const std::uint32_t index = free_.front();
        free_.pop_front();
        void* to = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, memory_,
                        static_cast<off_t>(room_ * index));
        std::memcpy(to, picture_.data(), bytes_);
        munmap(to, bytes_);
        const auto isDue = [&](const char* word) {
            const auto at = wrong.find(word);
            return at != wrong.end() && i % static_cast<std::uint64_t>(at->second) == 0;
        };
        v4l2_buffer said{};
        said.index = index;
        said.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        said.memory = V4L2_MEMORY_MMAP;
        said.sequence = number;
        said.length = static_cast<std::uint32_t>(bytes_);
        said.bytesused = said.length - (isDue("short") ? 4096 : 0);
        said.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
        if (isDue("error")) said.flags |= V4L2_BUF_FLAG_ERROR;
        std::int64_t stamp = us;
        if (isDue("backward")) stamp -= 200'000;
        if (isDue("future")) stamp += 3'600'000'000LL;
        said.timestamp.tv_sec = stamp / 1'000'000;
        said.timestamp.tv_usec = stamp % 1'000'000;
        buffers_[index] = said;
        filled_.push_back(index);
        const std::uint64_t one = 1;
        static_cast<void>(!write(fd_, &one, sizeof one));
        return true;
    }

    const WordFile words_;
    const std::string name_;
    const double plug_;  ///< number after the word "unplug" when the device was opened
    const int fd_;       ///< readable while a filled buffer waits; the program closes it
    const int memory_;
    std::atomic<double> rateHz_{30};
    std::size_t bytes_ = 0, room_ = 0;
    std::int64_t pulse_ = 0;  ///< time of the last pulse that the camera noticed [us]
    off_t mapped_ = 0;
    int width_ = 0;
    int refused_ = 0;
    std::atomic<bool> running_{false}, isLost_{false};
    std::atomic<int> lostError_{0};
    std::thread maker_;
    std::vector<std::uint8_t> picture_;
    std::optional<std::int64_t> lastGood_;
    std::mutex mutex_;
    std::vector<v4l2_buffer> buffers_;
    std::deque<std::uint32_t> free_, filled_;
};

}  // namespace mfar::pretended
