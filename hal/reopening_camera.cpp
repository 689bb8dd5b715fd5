#include "hal/reopening_camera.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

std::string sizeText(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

ReopeningCamera::ReopeningCamera(CameraInfo info, Open open, const ReopeningOptions& options)
    : info_(std::move(info)), open_(std::move(open)), options_(options),
      fault_(info_.name + " is being opened") {}

ReopeningCamera::~ReopeningCamera() {
    stop();
    if (opener_.joinable()) opener_.join();
}

void ReopeningCamera::start() {
    opener_ = std::thread([this] { keepOpen(); });
}

// Runs on the opener's thread, because closing and opening a device may take long. A lost device
// must be closed before it can be opened again.
void ReopeningCamera::keepOpen() {
    Heartbeat heart(options_.opener);
    heart.rest();
    std::chrono::milliseconds pause = options_.firstPause;
    std::unique_lock lock(mutex_);
    const auto rest = [&] {
        changed_.wait_for(lock, pause, [&] { return stopped_; });
        pause = std::min(2 * pause, options_.longestPause);
    };
    const auto work = [&](const auto& call) {
        busy_ = Timestamp::now();
        heart.beat();
        lock.unlock();
        call();
        lock.lock();
        heart.rest();
        busy_.reset();
    };
    while (!stopped_) {
        if (std::shared_ptr<Camera> lost = std::exchange(lost_, nullptr)) {
            work([&] { lost.reset(); });
            if (hasSent_ || Timestamp::now() - opened_ > options_.longestPause)
                pause = options_.firstPause;
            else
                rest();
            if (stopped_) return;
        }
        std::shared_ptr<Camera> camera;
        work([&] { camera = tryOpen(); });
        if (camera)
            take(std::move(camera));
        else
            rest();
        changed_.wait(lock, [&] { return stopped_ || !camera_; });
    }
    // The camera is stopped on this thread, because ReopeningCamera::stop() must not wait for the
    // driver.
    if (const std::shared_ptr<Camera> camera = camera_) work([&] { camera->stop(); });
}

/// The caller of take() and hangs() must have locked mutex_.
void ReopeningCamera::take(std::shared_ptr<Camera> camera) {
    for (std::string& text : camera->takeWarnings())
        warnings_.push_back(std::move(text));
    camera_ = std::move(camera);
    opened_ = lastFrame_ = Timestamp::now();
    hasSent_ = false;
    changed_.notify_all();
}

std::shared_ptr<Camera> ReopeningCamera::tryOpen() {
    try {
        std::shared_ptr<Camera> camera = open_();
        if (const Size size = camera->info().size; size != info_.size)
            throw std::runtime_error("delivers pictures of " + sizeText(size) + " instead of " +
                                     sizeText(info_.size));
        camera->start();
        return camera;
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        fault_ = info_.name + ": " + error.what();
        return nullptr;
    }
}

std::shared_ptr<Camera> ReopeningCamera::opened(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    const Timestamp end = Timestamp::now() + timeout;
    changed_.wait_for(lock, timeout, [&] { return stopped_ || camera_; });
    if (stopped_ || !camera_) return nullptr;
    answer_ = end;
    return camera_;
}

std::optional<Frame> ReopeningCamera::next(std::chrono::milliseconds timeout) {
    const Timestamp end = Timestamp::now() + timeout;
    std::shared_ptr<Camera> camera = opened(timeout);
    if (!camera) return std::nullopt;
    std::string reason = "sends no pictures";
    try {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            std::max(end - Timestamp::now(), std::chrono::nanoseconds{0}));
        std::optional<Frame> frame = camera->next(left);
        if (frame || !hasStalled()) {
            if (frame) sent();
            return frame;
        }
    } catch (const std::exception& error) {
        reason = error.what();
    }
    camera.reset();
    reopen(reason);
    return std::nullopt;
}

void ReopeningCamera::sent() {
    const std::lock_guard lock(mutex_);
    answer_.reset();
    lastFrame_ = Timestamp::now();
    hasSent_ = true;
    fault_.reset();
}

bool ReopeningCamera::hasStalled() {
    // busyElsewhere() is called before mutex_ is locked, because it may call another camera, which
    // may in turn call this camera.
    const bool isExcused = options_.busyElsewhere && options_.busyElsewhere();
    const std::lock_guard lock(mutex_);
    answer_.reset();
    if (options_.silent.count() == 0) {
        // A triggered camera may be silent; it works if the device is open.
        fault_.reset();
        return false;
    }
    // A slow camera's limit may be longer than the one for excused frames.
    const auto limit = isExcused ? std::max(options_.excused, options_.stalled) : options_.stalled;
    return Timestamp::now() - lastFrame_ >= limit;
}

void ReopeningCamera::reopen(const std::string& reason) {
    {
        const std::lock_guard lock(mutex_);
        answer_.reset();
        fault_ = info_.name + ": " + reason;
        if (!camera_) return;
        lost_ = std::exchange(camera_, nullptr);
        ++losses_;
        before_ += lost_->cameraCounters();
    }
    changed_.notify_all();
}

void ReopeningCamera::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_all();
}

bool ReopeningCamera::hangs() const {
    const Timestamp now = Timestamp::now();
    return (answer_ && now - *answer_ >= options_.stalled) ||
           (busy_ && now - *busy_ >= options_.excused);
}

std::optional<std::string> ReopeningCamera::fault() const {
    const std::lock_guard lock(mutex_);
    if (hangs()) return info_.name + ": its driver does not answer";
    if (fault_) return fault_;
    if (options_.silent.count() > 0 && Timestamp::now() - lastFrame_ > options_.silent)
        return info_.name + ": sends no pictures";
    return std::nullopt;
}

bool ReopeningCamera::absent() const {
    const std::lock_guard lock(mutex_);
    return camera_ == nullptr;
}

std::uint64_t ReopeningCamera::losses() const {
    const std::lock_guard lock(mutex_);
    return losses_;
}

CameraCounters ReopeningCamera::cameraCounters() const {
    const std::lock_guard lock(mutex_);
    CameraCounters all = before_;
    if (camera_) all += camera_->cameraCounters();
    all.reopened = losses_;
    return all;
}

std::vector<std::string> ReopeningCamera::takeWarnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
}

}  // namespace mfar
