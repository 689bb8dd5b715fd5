#include "hal/virtual/synthetic_studio.h"

#include "hal/virtual/synthetic_views.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

using namespace std::chrono_literals;

constexpr Timestamp kConsumerEpoch{1'000'000'000};

synthetic::SensorLook videoLook(double noise) {
    synthetic::SensorLook look;
    look.gain = {0.94F, 0.95F, 0.97F};
    look.gamma = 2.2F;
    look.blurSigma = 0.36F;
    look.shotNoise = static_cast<float>(2.0e-4 * noise * noise);
    look.readNoise = static_cast<float>(2.0e-6 * noise * noise);
    return look;
}

synthetic::SensorLook highResLook() {
    synthetic::SensorLook look = videoLook(0);
    look.blurSigma = 0;
    return look;
}

synthetic::SensorLook stillLook(double noise) {
    synthetic::SensorLook look;
    look.gain = {0.86F, 0.83F, 0.80F};
    look.gamma = 1.95F;
    look.blurSigma = 0.5F;
    look.shotNoise = static_cast<float>(0.7e-4 * noise * noise);
    look.readNoise = static_cast<float>(0.8e-6 * noise * noise);
    return look;
}

}  // namespace

SyntheticStudio::Views::Views(const SyntheticOptions& options, const synthetic::World& world,
                              const StereoRig& rig)
    : gl(createGlContext()), shared(world, options.seed),
      video(shared, rig.video, videoLook(options.noise)),
      still(shared, rig.still, stillLook(options.noise)),
      highRes(shared, rig.video.scaledTo(rig.still.size), highResLook()) {}

SyntheticStudio::SyntheticStudio(const SyntheticOptions& options, const synthetic::World& world,
                                 const StereoRig& rig)
    : options_(options), world_(world), rig_(rig),
      epoch_(options.pace == Pace::Realtime ? Timestamp::now() : kConsumerEpoch),
      videoPool_(rig.video.size, PixelFormat::Rgba8, std::max(2, options.videoBuffers)),
      stillPool_(rig.still.size, PixelFormat::Rgba8, std::max(2, options.stillBuffers)),
      start_(epoch_) {
    if (!(options.rateHz > 0)) throw std::invalid_argument("synthetic board: rateHz must be > 0");
    std::promise<void> ready;
    std::future<void> started = ready.get_future();
    thread_ = std::thread([this, &ready] { run(ready); });
    try {
        started.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

SyntheticStudio::~SyntheticStudio() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

Timestamp SyntheticStudio::now() const {
    if (options_.pace == Pace::Realtime) return Timestamp::now();
    return handed_.value_or(start_);
}

Timestamp SyntheticStudio::videoTime(long long index) const {
    return start_ + std::chrono::nanoseconds(
                        std::llround(static_cast<double>(index) * 1e9 / options_.rateHz));
}

Pose SyntheticStudio::pose(Timestamp t) const {
    return {t, synthetic::cameraPose(world_, *options_.path, options_.seed, worldTime(t))};
}

void SyntheticStudio::startVideo() {
    const std::lock_guard lock(mutex_);
    if (videoOn_) return;
    videoOn_ = true;
    // With Pace::Realtime, the first start() sets the time of frame 0. If the camera is stopped and
    // started again, the times have a gap.
    if (options_.pace == Pace::Realtime && nextIndex_ == 0) start_ = Timestamp::now();
    changed_.notify_all();
}

void SyntheticStudio::startStills() {
    const std::lock_guard lock(mutex_);
    stillsOn_ = true;
}

void SyntheticStudio::stopVideo() {
    const std::lock_guard lock(mutex_);
    videoOn_ = false;
    video_.clear();
    changed_.notify_all();
}

void SyntheticStudio::stopStills() {
    const std::lock_guard lock(mutex_);
    stillsOn_ = false;
    stills_.clear();
    changed_.notify_all();
}

Timestamp SyntheticStudio::fire() {
    const std::lock_guard lock(mutex_);
    const Timestamp t = now();
    const bool exposing =
        lastFire_ && t < *lastFire_ + options_.stillDelay + options_.stillExposure;
    const bool full = static_cast<int>(stills_.size()) >= std::max(1, options_.stillBuffers - 1);
    if (!stillsOn_ || exposing || full) return t;
    lastFire_ = t;
    stills_.push_back(
        {t + options_.stillDelay + options_.stillExposure / 2, t + options_.stillLatency});
    changed_.notify_all();
    return t;
}

bool SyntheticStudio::isStillComing() const {
    const std::lock_guard lock(mutex_);
    return !stills_.empty();
}

bool SyntheticStudio::videoAllMade() const {
    return options_.frames > 0 && videoMade_ >= options_.frames;
}

bool SyntheticStudio::videoDone() const {
    return videoAllMade() && video_.empty();
}

bool SyntheticStudio::videoEnded() const {
    const std::lock_guard lock(mutex_);
    return videoDone();
}

bool SyntheticStudio::stillsEnded() const {
    const std::lock_guard lock(mutex_);
    return videoDone() && stills_.empty();
}

void SyntheticStudio::rethrowFailure() const {
    if (failure_) std::rethrow_exception(failure_);
}

std::optional<Frame> SyntheticStudio::nextVideo(std::chrono::milliseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    std::unique_lock lock(mutex_);
    const auto ready = [&] {
        if (video_.empty()) return false;
        // With Pace::Consumer, a frame waits until all stills that become available up to its time
        // are rendered. So every run gives the same result.
        const Timestamp time = video_.front().time();
        return options_.pace == Pace::Realtime || std::ranges::all_of(stills_, [&](const Still& s) {
                   return s.frame || s.available > time;
               });
    };
    while (!ready()) {
        rethrowFailure();
        if (!videoOn_ || videoDone()) return std::nullopt;
        if (options_.pace == Pace::Consumer && !starved_)
            changed_.wait(lock);
        else if (changed_.wait_until(lock, deadline) == std::cv_status::timeout && !ready())
            return std::nullopt;
    }
    Frame frame = std::move(video_.front());
    video_.pop_front();
    handed_ = frame.time();
    changed_.notify_all();
    return frame;
}

// Returns true if the next still may be delivered: it is rendered, and its latency has passed. With
// Pace::Consumer, the clock stops at the end of the video. From then on, the latency is ignored if
// the caller waits for the still. Other callers get no still: whether they got one would depend on
// the renderer's speed.
bool SyntheticStudio::stillReady(bool mayWait) const {
    if (stills_.empty() || !stills_.front().frame) return false;
    return now() >= stills_.front().available ||
           (mayWait && options_.pace == Pace::Consumer && videoDone());
}

std::optional<Frame> SyntheticStudio::nextStill(std::chrono::milliseconds timeout) {
    auto deadline = std::chrono::steady_clock::now() + timeout;
    std::unique_lock lock(mutex_);
    while (!stillReady(timeout > 0ms)) {
        rethrowFailure();
        if (!stillsOn_ || (videoDone() && stills_.empty())) return std::nullopt;
        const auto left = deadline - std::chrono::steady_clock::now();
        if (left <= 0ns) return std::nullopt;
        // A rendered still becomes ready when its latency has passed. Nothing signals this moment,
        // so it is checked every 2 ms.
        const bool latent = !stills_.empty() && stills_.front().frame;
        changed_.wait_for(lock, latent ? std::min<std::chrono::nanoseconds>(left, 2ms) : left);
    }
    Frame frame = std::move(*stills_.front().frame);
    stills_.pop_front();
    changed_.notify_all();
    return frame;
}

StoredImage SyntheticStudio::cleanVideo(Timestamp t) {
    return request([this, t](Views& views) { return picture(views.video, t); });
}

StoredImage SyntheticStudio::highRes(Timestamp t) {
    return request([this, t](Views& views) { return picture(views.highRes, t); });
}

StoredImage SyntheticStudio::request(std::function<StoredImage(Views&)> make) {
    std::packaged_task<StoredImage(Views&)> task(std::move(make));
    std::future<StoredImage> result = task.get_future();
    {
        const std::lock_guard lock(mutex_);
        rethrowFailure();
        requests_.push_back(std::move(task));
    }
    changed_.notify_all();
    try {
        return result.get();
    } catch (const std::future_error&) {
        // The studio's thread has failed and discarded the request.
        const std::lock_guard lock(mutex_);
        rethrowFailure();
        throw;
    }
}

StoredImage SyntheticStudio::picture(synthetic::SensorView& view, Timestamp t) {
    StoredImage out{view.size(), PixelFormat::Rgba8, {}};
    out.pixels.resize(static_cast<std::size_t>(out.size.width) * out.size.height * 4);
    view.begin(pose(t).T_world_video, worldTime(t), 0);
    while (!view.step()) {
    }
    view.read(out.pixels.data());
    return out;
}

}  // namespace mfar
