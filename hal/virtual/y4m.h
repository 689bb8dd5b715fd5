#pragma once

#include "base/image_view.h"
#include "base/owned_fd.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Returns the line "YUV4MPEG2 ..." with its newline. The frame rate is written as a fraction with
/// a denominator of at most 1001.
[[nodiscard]] std::string y4mHeader(Size size, double rateHz);

/// Appends "FRAME" and the three planes of an RGBA8 picture: 4:2:0, BT.601 limited range, each
/// chroma sample in the centre of its four pixels. If the width or height is odd, the last column
/// or row of pixels is repeated for the last chroma samples.
void appendY4mFrame(const ImageView& rgba, std::vector<std::uint8_t>& out);

/// Writes bytes to a file, a FIFO or standard output ("-"). Only one thread at a time may use it.
/// That thread must block or ignore SIGPIPE.
class ByteSink {
public:
    /// If the target is a FIFO, waits up to 5 s for a reader. Throws std::runtime_error.
    ByteSink(std::string_view target, std::stop_token cancel);
    ByteSink(const ByteSink&) = delete;
    ByteSink& operator=(const ByteSink&) = delete;

    /// Writes all bytes. Waits for the reader of a pipe, until a stop is requested through
    /// `cancel`. Throws std::runtime_error "target: reason".
    void write(std::span<const std::uint8_t> bytes);
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool isPipe() const { return isPipe_; }

private:
    [[nodiscard]] int open(const char* path) const;
    void waitForReader() const;
    [[noreturn]] void fail(std::string_view what) const;

    std::string name_;
    std::stop_token cancel_;
    OwnedFd fd_;
    bool isPipe_ = false;
};

}  // namespace mfar
