#include "daemon/camera_reader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {

CameraReader::CameraReader(Rig& rig, CameraRole role, Stats& stats)
    : camera_(role == CameraRole::Video ? rig.video() : rig.still()), role_(role),
      expected_(role == CameraRole::Video ? rig.geometry().video.size : rig.geometry().still.size),
      failure_(rig.inputFailure()), watch_(camera_.info(), rig.cameraKind()), stats_(stats) {}

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
    if (frame) watch_.add(*frame, Timestamp::now());
    tell();
    if (!frame) return frame;
    const Size size = frame->view().size;
    if (size != expected_)
        throw Failure(failure_,
                      fmt::format("{}: sent a picture of {}x{}, but the calibration is for {}x{}",
                                  camera_.info().name, size.width, size.height, expected_.width,
                                  expected_.height));
    return frame;
}

void CameraReader::tell() {
    watch_.add(camera_.cameraCounters());
    stats_.camera(role_, watch_.state());
    const Subject subject{message::kCamera, role_ == CameraRole::Video ? "video" : "still"};
    for (std::string& text : camera_.takeWarnings())
        stats_.warn(std::move(text), subject);
    for (std::string& text : watch_.takeWarnings())
        stats_.warn(std::move(text), subject);
}

}  // namespace mfar
