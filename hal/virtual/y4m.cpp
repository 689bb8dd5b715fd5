#include "hal/virtual/y4m.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

namespace mfar {
namespace {

constexpr std::chrono::seconds kReaderWait{5};
constexpr int kCancelPollMs = 100;

std::string reason(int error) {
    return std::generic_category().message(error);
}

}  // namespace

std::string y4mHeader(Size size, double rateHz) {
    long numerator = std::lround(rateHz), denominator = 1;
    if (std::abs(rateHz - static_cast<double>(numerator)) > 1e-6) {
        denominator =
            std::abs(rateHz * 1001 - std::round(rateHz * 1001 / 1000) * 1000) < 1 ? 1001 : 1000;
        numerator = std::lround(rateHz * static_cast<double>(denominator));
    }
    return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n",
                       size.width, size.height, numerator, denominator);
}

void appendY4mFrame(const ImageView& rgba, std::vector<std::uint8_t>& out) {
    const int width = rgba.size.width, height = rgba.size.height;
    const cv::Mat source(height, width, CV_8UC4, const_cast<std::uint8_t*>(rgba.data), rgba.stride);
    cv::Mat even = source, half, means, planes, planesOfMeans;
    if (width % 2 != 0 || height % 2 != 0)
        cv::copyMakeBorder(source, even, 0, height % 2, 0, width % 2, cv::BORDER_REPLICATE);
    cv::cvtColor(even, planes, cv::COLOR_RGBA2YUV_I420);
    // cvtColor() computes chroma from the first of four pixels. So the chroma planes are computed
    // from a second picture, in which all four pixels have their mean.
    cv::resize(even, half, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::resize(half, means, even.size(), 0, 0, cv::INTER_NEAREST);
    cv::cvtColor(means, planesOfMeans, cv::COLOR_RGBA2YUV_I420);
    constexpr std::string_view kFrame = "FRAME\n";
    out.insert(out.end(), kFrame.begin(), kFrame.end());
    for (int y = 0; y < height; ++y)
        out.insert(out.end(), planes.ptr(y), planes.ptr(y) + width);
    const std::uint8_t* chroma = planesOfMeans.ptr(even.rows);
    out.insert(out.end(), chroma, chroma + even.total() / 2);
}

ByteSink::ByteSink(std::string_view target, std::stop_token cancel)
    : name_(target == "-" ? "standard output" : target), cancel_(std::move(cancel)) {
    if (target.empty())
        throw std::runtime_error("y4m: needs a file name, or - for standard output");
    fd_ = OwnedFd(target == "-" ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3) : open(name_.c_str()));
    if (!fd_) fail(reason(errno));
    struct stat info{};
    const bool known = fstat(fd_.get(), &info) == 0;
    isPipe_ = known && (S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode));
    if (isatty(fd_.get()) != 0) fail("is a terminal; a video stream needs a pipe or a file");
}

int ByteSink::open(const char* path) const {
    const auto deadline = std::chrono::steady_clock::now() + kReaderWait;
    for (;;) {
        const int fd =
            ::open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
        if (fd >= 0 || errno != ENXIO) return fd;
        if (cancel_.stop_requested() || std::chrono::steady_clock::now() >= deadline)
            fail("no program reads this pipe");
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

void ByteSink::write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        if (isPipe_) waitForReader();
        // After poll() reports a pipe as writable, PIPE_BUF bytes can be written without blocking.
        // O_NONBLOCK is not set for standard output, because other processes may share that file.
        const std::size_t chunk =
            isPipe_ ? std::min<std::size_t>(bytes.size(), PIPE_BUF) : bytes.size();
        const ssize_t n = ::write(fd_.get(), bytes.data(), chunk);
        if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (n < 0) fail(errno == EPIPE ? "the reading program has closed the pipe" : reason(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

void ByteSink::waitForReader() const {
    pollfd writable{fd_.get(), POLLOUT, 0};
    while (poll(&writable, 1, kCancelPollMs) <= 0)
        if (cancel_.stop_requested()) fail("stopped while the reading program accepted no data");
}

void ByteSink::fail(std::string_view what) const {
    throw std::runtime_error(fmt::format("{}: {}", name_, what));
}

}  // namespace mfar
