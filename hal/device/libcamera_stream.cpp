#include "hal/device/libcamera_stream.h"

#include "hal/device/libcamera_manager.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kLeastBuffers = 2;
/// Longest time that libcamera needs, on a busy machine, to learn from udev that a device was
/// unplugged.
constexpr std::chrono::seconds kUdevTime{30};
constexpr std::chrono::milliseconds kNodeLook{100};

void check(const LibcameraOptions& options) {
    const Size size = options.size;
    if (size.width < 2 || size.height < 2 || size.width % 2 != 0 || size.height % 2 != 0)
        throw std::runtime_error(
            fmt::format("picture size {}x{} is invalid: width and height must be positive and even",
                        size.width, size.height));
    if (!(options.rateHz >= 0 && options.rateHz <= 1000))
        throw std::runtime_error("a camera's rate must be from 0 to 1000 Hz");
    if (options.buffers < kLeastBuffers || options.buffers > 64)
        throw std::runtime_error("the number of buffers of a camera must be from 2 to 64");
}

/// Returns true if this process has opened a video device whose node is deleted. The kernel deletes
/// the node of an unplugged device before it notifies anybody.
bool hasLostVideoNode() {
    namespace fs = std::filesystem;
    // A destructor calls this function, so it uses the overloads that do not throw.
    std::error_code ended, closed;
    for (fs::directory_iterator fd("/proc/self/fd", ended);
         !ended && fd != fs::directory_iterator(); fd.increment(ended)) {
        const std::string file = fs::read_symlink(fd->path(), closed).string();
        if (file.starts_with("/dev/video") && file.ends_with(" (deleted)")) return true;
    }
    return false;
}

}  // namespace

LibcameraCamera::Stream::Stream(const LibcameraOptions& options) : options_(options) {
    check(options);
    manager_ = libcameraManager();
    camera_ = findLibcamera(*manager_, options.camera);
    id_ = camera_->id();
    cycle_.setName(fmt::format("camera '{}'", id_));
    if (const int error = camera_->acquire(); error != 0)
        throw std::runtime_error(
            fmt::format("camera '{}' is {}", id_,
                        error == -EBUSY ? "in use by another program, or cannot run together with "
                                          "the other camera of this program"
                                        : fmt::format("not available (error {})", -error)));
    try {
        open();
    } catch (...) {
        slots_.clear();
        allocator_.reset();
        camera_->release();
        throw;
    }
}

void LibcameraCamera::Stream::open() {
    configured_ = configureLibcamera(*camera_, options_);
    controls_ = controlsFor(*camera_, options_);
    stream_ = configured_.configuration->at(0).stream();
    times_.emplace(leastBytes(configured_.layout), options_.rateHz);
    allocate();
    camera_->requestCompleted.connect(this, &Stream::completed);
    camera_->disconnected.connect(this, &Stream::disconnected);
}

void LibcameraCamera::Stream::allocate() {
    allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
    if (const int count = allocator_->allocate(stream_); count < static_cast<int>(kLeastBuffers))
        throw std::runtime_error(fmt::format(
            "camera '{}' did not allocate enough picture buffers (result {})", id_, count));
    for (const auto& buffer : allocator_->buffers(stream_)) {
        Slot slot;
        slot.request = camera_->createRequest(slots_.size());
        if (!slot.request || slot.request->addBuffer(stream_, buffer.get()) != 0)
            throw std::runtime_error(
                fmt::format("camera '{}': a capture request cannot be created", id_));
        slot.picture = std::make_shared<MappedPicture>(*buffer, configured_.layout);
        slots_.push_back(std::move(slot));
        cycle_.add();
    }
}

void LibcameraCamera::Stream::close() {
    end();
    camera_->requestCompleted.disconnect(this);
    camera_->disconnected.disconnect(this);
    cycle_.close();
    // Requests must be destroyed before the camera, and buffers before the allocator.
    slots_.clear();
    allocator_.reset();
    configured_.configuration.reset();
    camera_->release();
    camera_.reset();
    manager_.reset();
}

CameraInfo LibcameraCamera::Stream::info() const {
    return {id_, configured_.layout.size, configured_.layout.format, options_.rateHz};
}

void LibcameraCamera::Stream::start() {
    libcamera::ControlList initial(camera_->controls());
    for (const auto& [id, value] : controls_)
        initial.set(id, value);
    if (const int error = camera_->start(&initial); error != 0) {
        const std::string text =
            fmt::format("camera '{}' cannot be started (error {})", id_, -error);
        if (error == -ENODEV) throw DeviceLost(text);
        throw std::runtime_error(text);
    }
    controlsDue_ = true;
    const std::lock_guard lock(mutex_);
    times_->pause();
}

int LibcameraCamera::Stream::queue(std::size_t slot) {
    libcamera::Request& request = *slots_[slot].request;
    request.reuse(libcamera::Request::ReuseBuffers);
    // Some drivers (uvcvideo) ignore the controls of start() and read only the controls of
    // requests.
    for (const auto& [id, value] : controlsDue_ ? controls_ : ControlValues{})
        request.controls().set(id, value);
    controlsDue_ = false;
    return camera_->queueRequest(&request);
}

// If a camera was unplugged, waits until libcamera has noticed. libcamera would end the process if
// a camera with queued requests were stopped before that. The kernel deletes the device's node
// first, so the deleted node shows that libcamera still has to notice.
void LibcameraCamera::Stream::prepareStop() {
    const auto end = std::chrono::steady_clock::now() + kUdevTime;
    while (hasLostVideoNode() && std::chrono::steady_clock::now() < end)
        if (cycle_.awaitSign(kNodeLook) || unplugged_) return;
}

void LibcameraCamera::Stream::stop() {
    camera_->stop();
}

/// libcamera's thread calls disconnected() and completed().
void LibcameraCamera::Stream::disconnected() {
    unplugged_ = true;
    cycle_.lose(fmt::format("camera '{}' has been unplugged", id_));
}

void LibcameraCamera::Stream::completed(libcamera::Request* request) {
    const auto slot = static_cast<std::size_t>(request->cookie());
    if (request->status() == libcamera::Request::RequestCancelled) return cycle_.cancelled(slot);
    cycle_.completed(slot, [&] { return judge(slot, *request); });
}

std::optional<RequestCycle::Done> LibcameraCamera::Stream::judge(std::size_t slot,
                                                                 libcamera::Request& request) {
    namespace controls = libcamera::controls;
    const libcamera::FrameMetadata& metadata = request.findBuffer(stream_)->metadata();
    const libcamera::ControlList& told = request.metadata();
    PictureTimes::Reported picture;
    picture.isStartup = libcamera_compat::isStartup(metadata);
    picture.failed = metadata.status != libcamera::FrameMetadata::FrameSuccess;
    for (const auto& plane : metadata.planes())
        picture.bytes += plane.bytesused;
    picture.sequence = metadata.sequence;
    picture.stamp =
        told.get(controls::SensorTimestamp).value_or(static_cast<std::int64_t>(metadata.timestamp));
    picture.exposure = std::chrono::microseconds(told.get(controls::ExposureTime).value_or(0));
    const std::lock_guard lock(mutex_);
    const std::optional<Timestamp> time = times_->add(picture, SensorClock::Now::read());
    if (!time) return std::nullopt;
    checkView(told);
    return RequestCycle::Done{slot, *time, picture.exposure};
}

void LibcameraCamera::Stream::checkView(const libcamera::ControlList& told) {
    if (viewChecked_) return;
    viewChecked_ = true;
    const auto crop = told.get(libcamera::controls::ScalerCrop);
    viewFault_ = cropFault(*camera_, crop, options_).value_or(std::string());
}

std::optional<Frame> LibcameraCamera::Stream::next(std::chrono::milliseconds timeout) {
    const std::optional<RequestCycle::Done> done = cycle_.next(timeout);
    {
        const std::lock_guard lock(mutex_);
        if (!viewFault_.empty()) throw std::runtime_error(viewFault_);
    }
    if (!done) return std::nullopt;
    const std::shared_ptr<const MappedPicture> picture = slots_[done->request].picture;
    picture->beginRead();
    Frame frame(picture->view(), done->time,
                [picture, stream = weak_from_this(), slot = done->request] {
                    picture->endRead();
                    if (const auto alive = stream.lock()) alive->cycle_.giveBack(slot);
                });
    frame.exposure = done->exposure;
    return frame;
}

LibcameraCounters LibcameraCamera::Stream::counters() const {
    const std::uint64_t frames = cycle_.delivered(), restarts = cycle_.restarts();
    const std::lock_guard lock(mutex_);
    const PictureTimes::Counters& pictures = times_->counters();
    return {frames,           times_->dropped(), pictures.broken,
            pictures.startup, pictures.badTimes, pictures.untimed,
            restarts,         times_->clock()};
}

}  // namespace mfar
