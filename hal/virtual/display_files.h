#pragma once

#include "base/heartbeats.h"
#include "hal/display.h"

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

namespace mfar {

/// What a display does that writes slower than pictures come.
struct FileDisplayPolicy {
    /// Pictures of a live source: show() never waits. The newest pictures are written, others are
    /// left out and counted, see Display::leftOut(), and fault() says when nothing is written any
    /// more. Else every picture is written, and show() waits.
    bool isLive = false;
    /// Called on the thread of show() and finish() when they begin to wait, with what for, and with
    /// nullptr when that is over.
    std::function<void(const char* what)> waiting{};
    /// One picture that takes longer than this to write is a fault.
    std::chrono::milliseconds stalled{2000};
    /// Of a live source, finish() gives one up that takes longer than this.
    std::chrono::milliseconds finish{5000};
    WatchedThread writer{};  ///< which writes; its budget is for one picture
};

/// Opens a display that needs no screen:
///   "none"      shows nothing; show() waits until the picture is drawn, as a screen would
///   "png:DIR"   one file <ns>.png per picture in DIR (created); a repeated time replaces its file
///   "y4m:FILE"  YUV4MPEG2, 4:2:0, BT.601 limited range, `rateHz` in its header; FILE may be a FIFO
///               (a reader is waited for, up to 5 s) or "-" for standard output
/// Every picture is written, unless the policy says otherwise: show() waits while all buffers wait
/// for the disk or the reader.
/// Both show() and finish() throw std::runtime_error once a write has failed; a pipe whose reader
/// has gone is such a failure. A request on `cancel` ends all waiting for a pipe's reader, also as
/// such a failure. Throws std::runtime_error for an unknown kind, or a folder, file or pipe that
/// cannot be written.
[[nodiscard]] std::unique_ptr<Display> openFileDisplay(std::string_view spec, double rateHz,
                                                       std::stop_token cancel = {},
                                                       const FileDisplayPolicy& policy = {});

}  // namespace mfar
