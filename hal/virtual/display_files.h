#pragma once

#include "hal/display.h"

#include <memory>
#include <stop_token>
#include <string_view>

namespace mfar {

/// Opens a display that needs no screen:
///   "none"      shows nothing; show() waits until the picture is drawn, as a screen would
///   "png:DIR"   one file <ns>.png per picture in DIR (created); a repeated time replaces its file
///   "y4m:FILE"  YUV4MPEG2, 4:2:0, BT.601 limited range, `rateHz` in its header; FILE may be a FIFO
///               (a reader is waited for, up to 5 s) or "-" for standard output
/// Every picture is written: show() waits while all buffers wait for the disk or the reader.
/// Both show() and finish() throw std::runtime_error once a write has failed; a pipe whose reader
/// has gone is such a failure. A request on `cancel` ends all waiting for a pipe's reader, also as
/// such a failure. Throws std::runtime_error for an unknown kind, or a folder, file or pipe that
/// cannot be written.
[[nodiscard]] std::unique_ptr<Display> openFileDisplay(std::string_view spec, double rateHz,
                                                       std::stop_token cancel = {});

}  // namespace mfar
