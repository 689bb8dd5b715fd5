#include "hal/device/libcamera_log.h"

#include <algorithm>
#include <cstdlib>
#include <libcamera/logging.h>
#include <mutex>
#include <ostream>
#include <streambuf>

namespace mfar {
namespace {

/// libcamera writes each message with one call of write().
class Lines : public std::streambuf {
public:
    void setReceiver(LibcameraLog::Receiver receiver) {
        const std::lock_guard lock(mutex_);
        receiver_ = std::move(receiver);
    }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        const std::lock_guard lock(mutex_);
        std::string_view line(bytes, static_cast<std::size_t>(count));
        while (line.ends_with('\n'))
            line.remove_suffix(1);
        if (receiver_ && !line.empty()) receiver_(libcameraMessage(line));
        return count;
    }

private:
    std::mutex mutex_;
    LibcameraLog::Receiver receiver_;
};

/// libcamera keeps a pointer to the stream until the process ends.
Lines& lines() {
    static Lines lines;
    return lines;
}

std::ostream& stream() {
    static std::ostream stream(&lines());
    return stream;
}

/// Removes the first word and the space after it from `text`, and returns the word.
std::string_view takeWord(std::string_view& text) {
    const std::size_t end = text.find(' ');
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return word;
}

/// Returns the length of the device's name at the beginning of a message: "/dev/video0" of
/// "/dev/video0[17:cap]: Cannot start", "'imx219 10-0010'" of "'imx219 10-0010': Cannot start". The
/// number in brackets is a descriptor, which may change when the device is opened again.
std::size_t lengthOfDevice(std::string_view message) {
    if (message.starts_with('\'')) return message.find('\'', 1) + 1;
    return message.starts_with("/dev/") ? std::min(message.find_first_of("[: "), message.size())
                                        : 0;
}

}  // namespace

LibcameraMessage libcameraMessage(std::string_view line) {
    std::string_view rest = line;
    while (rest.starts_with('['))
        takeWord(rest);
    const bool hasTime = rest.size() < line.size();
    while (rest.starts_with(' '))
        rest.remove_prefix(1);
    const std::string_view withLevel = rest;
    takeWord(rest);
    const std::string_view text = rest;
    takeWord(rest);
    const bool hasPlace = takeWord(rest).find(':') != std::string_view::npos;
    if (!hasTime || !hasPlace || rest.empty()) return {std::string(line), std::string(line)};
    const std::size_t device = lengthOfDevice(rest);
    const std::size_t common = withLevel.size() - rest.size() + device - (device == 0 ? 1 : 0);
    return {std::string(withLevel.substr(0, common)), std::string(text)};
}

LibcameraLog::LibcameraLog(Receiver receiver) {
    const bool isSetByUser = std::getenv("LIBCAMERA_LOG_LEVELS") != nullptr ||
                             std::getenv("LIBCAMERA_LOG_FILE") != nullptr;
    setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
    if (isSetByUser) return;
    lines().setReceiver(std::move(receiver));
    libcamera::logSetStream(&stream());
}

LibcameraLog::~LibcameraLog() {
    lines().setReceiver({});
}

}  // namespace mfar
