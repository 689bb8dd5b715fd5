#pragma once

#include "base/heartbeats.h"
#include "hal/display.h"

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

namespace mfar {

/// Behaviour of a file display if pictures come faster than it writes them.
struct FileDisplayPolicy {
    /// True for a live source: show() never waits for a write; the oldest picture that waits to be
    /// written (or the new one, if none waits) is skipped and counted, see Display::leftOut().
    /// False: every picture is written, and show() waits.
    bool isLive = false;
    /// Called at the start of a wait with the name of the slow device or program, e.g. "the disk",
    /// and at the end of the wait with null.
    std::function<void(const char* what)> waiting{};
    /// If writing one picture takes longer than this, fault() reports a fault.
    std::chrono::milliseconds stalled{2000};
    /// With a live source: if writing one picture takes longer than this, finish() throws.
    std::chrono::milliseconds finish{5000};
    WatchedThread writer{};
};

/// Opens a display that needs no screen. `spec` is one of:
///   "none"      shows nothing; show() only waits until the GPU has drawn the picture
///   "png:DIR"   writes a file TIME.png [ns] per picture to DIR, which is created; a picture with
///               the same time replaces the file
///   "y4m:FILE"  writes YUV4MPEG2, 4:2:0, BT.601 limited range, with `rateHz` in the header. FILE
///               may be "-" (standard output) or a FIFO. Opening waits up to 5 s until a program
///               reads the FIFO
/// Unless policy.isLive is set, every picture is written, and show() waits while all buffers are in
/// use. After a write has failed, show() and finish() throw std::runtime_error. A write also fails
/// if a pipe's reader closes the pipe, or if a stop is requested through `cancel` while the write
/// waits for a pipe's reader. Throws std::runtime_error if `spec` is unknown, if the folder, file
/// or pipe cannot be written, or if `rateHz` of a Y4M video is outside 0.001 to 1000000 Hz.
[[nodiscard]] std::unique_ptr<Display> openFileDisplay(std::string_view spec, double rateHz,
                                                       std::stop_token cancel = {},
                                                       const FileDisplayPolicy& policy = {});

}  // namespace mfar
