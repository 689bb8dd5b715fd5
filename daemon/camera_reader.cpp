#include "daemon/camera_reader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mfar {

std::optional<Frame> CameraReader::next(std::chrono::milliseconds timeout) {
    std::optional<Frame> frame;
    waiting_ = true;
    try {
        frame = camera_.next(timeout);
    } catch (const std::runtime_error& error) {
        waiting_ = false;
        throw Failure(failure_, error.what());
    }
    waiting_ = false;
    if (!frame) return frame;
    const Size size = frame->view().size;
    if (size != expected_)
        throw Failure(failure_, fmt::format("{}: sent a picture of {}x{}, calibrated are {}x{}",
                                            camera_.info().name, size.width, size.height,
                                            expected_.width, expected_.height));
    return frame;
}

}  // namespace mfar
