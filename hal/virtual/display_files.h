#pragma once

#include "base/heartbeats.h"
#include "hal/display.h"

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

namespace mfar {

/// Behaviour of a display that writes more slowly than pictures arrive.
struct FileDisplayPolicy {
    /// For a live source: show() never waits. The newest pictures are written; others are skipped
    /// and counted, see Display::leftOut(), and fault() reports when nothing is written any more.
    /// Otherwise every picture is written, and show() waits.
    bool isLive = false;
    /// Called on the thread of show() and finish() when they begin to wait, with the name of the
    /// consumer, and with nullptr when the wait is over.
    std::function<void(const char* what)> waiting{};
    /// Writing one picture for longer than this is a fault.
    std::chrono::milliseconds stalled{2000};
    /// With a live source, finish() gives up after a picture has been writing for longer than this.
    std::chrono::milliseconds finish{5000};
    WatchedThread writer{};  ///< the writing thread; its budget is for one picture
};

/// Opens a display that needs no screen:
///   "none"      shows nothing; show() waits until the picture is drawn, as a screen would
///   "png:DIR"   one file <ns>.png per picture in DIR (created); a repeated time replaces its file
///   "y4m:FILE"  YUV4MPEG2, 4:2:0, BT.601 limited range, `rateHz` in its header; FILE may be a FIFO
///               (a reader is waited for, up to 5 s) or "-" for standard output
/// Every picture is written unless the policy says otherwise: show() waits while all buffers wait
/// for the disk or the reader. show() and finish() throw std::runtime_error after a write has
/// failed; a pipe whose reader is gone counts as a failure. A request on `cancel` ends all waiting
/// for a pipe's reader and counts as such a failure. Throws std::runtime_error for an unknown kind,
/// or a folder, file or pipe that cannot be written.
[[nodiscard]] std::unique_ptr<Display> openFileDisplay(std::string_view spec, double rateHz,
                                                       std::stop_token cancel = {},
                                                       const FileDisplayPolicy& policy = {});

}  // namespace mfar
