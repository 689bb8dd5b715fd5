#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace mfar {

struct LibcameraMessage {
    /// Level, category, source line and, if the message begins with it, the device's name. Two
    /// messages with the same event count as repetitions.
    std::string event;
    std::string text;  ///< without level, time and thread
};

/// Reads a line of libcamera's log: "[TIME] [THREAD] LEVEL CATEGORY FILE:LINE MESSAGE". If a line
/// does not have this form, both members of the result are the whole line.
[[nodiscard]] LibcameraMessage libcameraMessage(std::string_view line);

/// Sends libcamera's errors to a function instead of standard error. When this object is destroyed,
/// later messages are discarded. If the user has set LIBCAMERA_LOG_LEVELS or LIBCAMERA_LOG_FILE,
/// libcamera logs as these variables say. Only one object may exist. It must be created before
/// libcamera is used.
class LibcameraLog {
public:
    /// The function is called from the threads of libcamera, one call at a time. It must not throw.
    using Receiver = std::function<void(const LibcameraMessage&)>;

    explicit LibcameraLog(Receiver receiver);
    ~LibcameraLog();
    LibcameraLog(const LibcameraLog&) = delete;
    LibcameraLog& operator=(const LibcameraLog&) = delete;
};

}  // namespace mfar
