#include "hal/device/camera_libcamera.h"

#include "hal/device/libcamera_manager.h"
#include "hal/device/libcamera_stream.h"

namespace mfar {

LibcameraCamera::LibcameraCamera(const LibcameraOptions& options)
    : stream_(std::make_shared<Stream>(options)) {}

LibcameraCamera::~LibcameraCamera() {
    stream_->close();
}

CameraInfo LibcameraCamera::info() const {
    return stream_->info();
}

void LibcameraCamera::start() {
    stream_->begin();
}

std::optional<Frame> LibcameraCamera::next(std::chrono::milliseconds timeout) {
    return stream_->next(timeout);
}

void LibcameraCamera::stop() {
    stream_->end();
}

LibcameraCounters LibcameraCamera::counters() const {
    return stream_->counters();
}

CameraCounters LibcameraCamera::cameraCounters() const {
    const LibcameraCounters counted = counters();
    CameraCounters out;
    out.delivered = counted.frames;
    out.missed = counted.dropped;
    out.broken = counted.broken;
    out.badTimes = counted.badTimes;
    out.startup = counted.startup;
    out.untimed = counted.untimed;
    out.restarts = counted.restarted;
    return out;
}

std::vector<ListedCamera> listLibcameras() {
    return listCameras(libcameraManager()->cameras());
}

std::string chosenLibcamera(const CameraWish& wish) {
    return findLibcamera(*libcameraManager(), wish)->id();
}

}  // namespace mfar
