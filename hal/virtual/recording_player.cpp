#include "hal/virtual/recording_player.h"

#include "hal/virtual/image_files.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace mfar {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Timestamp kNever{std::numeric_limits<std::int64_t>::max()};
constexpr std::chrono::milliseconds kLongestWait{
    3'600'000};  // longest timeout, so that now + timeout cannot overflow
constexpr std::chrono::milliseconds kBufferPoll{20};

}  // namespace

/// The state that both cameras share. The mutex guards the members after it.
struct RecordingPlayer::Timeline {
    Pace pace = Pace::Realtime;
    bool loop = false;
    bool asksVideoFirst = false;
    Timestamp first;
    std::chrono::nanoseconds lap{0};

    mutable std::mutex mutex;
    std::condition_variable changed;
    std::optional<Clock::time_point> begin;
    Timestamp nextVideo;
    Timestamp newestVideo;

    [[nodiscard]] Clock::time_point due(Timestamp t) const { return *begin + (t - first); }
};

/// One of the two cameras. Pictures are numbered from 0, without a restart when the recording
/// loops.
class RecordingPlayer::Stream final : public Camera {
public:
    Stream(Timeline& timeline, const std::vector<RecordedImage>& images, CameraInfo info,
           bool isVideo, int buffers)
        : timeline_(timeline), images_(images), info_(std::move(info)), isVideo_(isVideo),
          pool_(info_.size, PixelFormat::Rgba8, images.empty() ? 0 : buffers),
          ahead_(static_cast<std::size_t>(buffers) / 2) {}
    ~Stream() override {
        stop();
        if (decoder_.joinable()) decoder_.join();
    }

    [[nodiscard]] CameraInfo info() const override { return info_; }
    void start() override;
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    void stop() override;
    [[nodiscard]] bool ended() const override {
        const std::lock_guard lock(timeline_.mutex);
        return stopped_ || timeOf(toGive_) == kNever;
    }
    [[nodiscard]] bool isEarly() const override {
        const std::lock_guard lock(timeline_.mutex);
        const Timestamp t = timeOf(toGive_);
        return timeline_.pace == Pace::Realtime && timeline_.begin && t != kNever && !isOpen(t);
    }
    [[nodiscard]] CameraCounters cameraCounters() const override {
        const std::lock_guard lock(timeline_.mutex);
        CameraCounters out;
        out.delivered = delivered_;
        if (skips()) out.missed = skipped_;
        return out;
    }

private:
    struct Decoded {
        std::size_t number = 0;
        std::optional<Frame> frame;
        std::string error;
    };

    [[nodiscard]] Timestamp timeOf(std::size_t number) const;
    [[nodiscard]] bool isOpen(Timestamp t) const;
    [[nodiscard]] Frame give(Decoded item);
    void decode();
    [[nodiscard]] bool skips() const { return isVideo_ && timeline_.pace == Pace::Realtime; }
    void dropLate();
    [[nodiscard]] std::size_t skipLate(std::size_t number);
    [[nodiscard]] std::optional<FramePool::Slot> waitForBuffer();
    [[nodiscard]] Decoded decodeInto(const FramePool::Slot& slot, std::size_t number) const;

    Timeline& timeline_;
    const std::vector<RecordedImage>& images_;
    CameraInfo info_;
    bool isVideo_;
    FramePool pool_;
    std::size_t ahead_;

    // The mutex of timeline_ guards the following members, except decoder_.
    std::deque<Decoded> ready_;
    std::size_t toGive_ = 0;
    std::uint64_t skipped_ = 0, delivered_ = 0;
    bool stopped_ = false;
    bool starved_ = false;

    std::thread decoder_;
};

Timestamp RecordingPlayer::Stream::timeOf(std::size_t number) const {
    if (images_.empty() || (!timeline_.loop && number >= images_.size())) return kNever;
    const auto laps = static_cast<std::int64_t>(number / images_.size());
    return images_[number % images_.size()].time + laps * timeline_.lap;
}

bool RecordingPlayer::Stream::isOpen(Timestamp t) const {
    if (timeline_.pace == Pace::Consumer) {
        const bool follows = timeline_.asksVideoFirst && timeline_.nextVideo != kNever;
        return isVideo_ || t <= (follows ? timeline_.newestVideo : timeline_.nextVideo);
    }
    return timeline_.begin && Clock::now() >= timeline_.due(t);
}

void RecordingPlayer::Stream::start() {
    const std::lock_guard lock(timeline_.mutex);
    if (stopped_ || decoder_.joinable())
        throw std::runtime_error(info_.name + ": a recording can be started only once");
    if (!timeline_.begin) timeline_.begin = Clock::now();
    decoder_ = std::thread([this] { decode(); });
}

void RecordingPlayer::Stream::stop() {
    {
        const std::lock_guard lock(timeline_.mutex);
        stopped_ = true;
    }
    timeline_.changed.notify_all();
}

std::optional<Frame> RecordingPlayer::Stream::next(std::chrono::milliseconds timeout) {
    const Clock::time_point deadline = Clock::now() + std::min(timeout, kLongestWait);
    std::unique_lock lock(timeline_.mutex);
    for (;;) {
        const Timestamp t = timeOf(toGive_);
        if (stopped_ || t == kNever) return std::nullopt;
        const bool open = isOpen(t);
        if (open && !ready_.empty()) {
            dropLate();
            Decoded item = std::move(ready_.front());
            ready_.pop_front();
            return give(std::move(item));
        }
        if (open && timeline_.pace == Pace::Consumer && decoder_.joinable() && !starved_) {
            timeline_.changed.wait(lock);
            continue;
        }
        if (Clock::now() >= deadline) return std::nullopt;
        const bool comesByTime = timeline_.pace == Pace::Realtime && timeline_.begin && !open;
        timeline_.changed.wait_until(lock,
                                     comesByTime ? std::min(deadline, timeline_.due(t)) : deadline);
    }
}

Frame RecordingPlayer::Stream::give(Decoded item) {
    toGive_ = item.number + 1;
    if (isVideo_) {
        timeline_.newestVideo = timeOf(item.number);
        timeline_.nextVideo = timeOf(toGive_);
    }
    timeline_.changed.notify_all();
    if (!item.frame) throw RecordingError(item.error);
    ++delivered_;
    return std::move(*item.frame);
}

void RecordingPlayer::Stream::decode() {
    for (std::size_t number = 0; timeOf(number) != kNever; ++number) {
        {
            std::unique_lock lock(timeline_.mutex);
            timeline_.changed.wait(lock, [this] { return stopped_ || ready_.size() < ahead_; });
        }
        const std::optional<FramePool::Slot> slot = waitForBuffer();
        if (!slot) return;
        number = skipLate(number);
        Decoded item = decodeInto(*slot, number);
        {
            const std::lock_guard lock(timeline_.mutex);
            ready_.push_back(std::move(item));
        }
        timeline_.changed.notify_all();
    }
}

std::optional<FramePool::Slot> RecordingPlayer::Stream::waitForBuffer() {
    std::optional<FramePool::Slot> slot = pool_.acquire(std::chrono::milliseconds(0));
    for (;;) {
        {
            const std::lock_guard lock(timeline_.mutex);
            starved_ = !slot;
            if (stopped_) break;
        }
        if (slot) return slot;
        timeline_.changed.notify_all();
        slot = pool_.acquire(kBufferPoll);
    }
    if (slot) pool_.giveBack(*slot);
    return std::nullopt;
}

// Drops decoded frames that are older than another frame that is due. The caller must have locked
// the mutex of timeline_.
void RecordingPlayer::Stream::dropLate() {
    while (skips() && ready_.size() > 1 && isOpen(timeOf(ready_[1].number))) {
        ready_.pop_front();
        ++skipped_;
    }
}

std::size_t RecordingPlayer::Stream::skipLate(std::size_t number) {
    if (!skips()) return number;
    const std::lock_guard lock(timeline_.mutex);
    for (Timestamp t; (t = timeOf(number + 1)) != kNever && isOpen(t); ++number)
        ++skipped_;
    return number;
}

RecordingPlayer::Stream::Decoded RecordingPlayer::Stream::decodeInto(const FramePool::Slot& slot,
                                                                     std::size_t number) const {
    Decoded item{number, std::nullopt, {}};
    try {
        loadImageInto(images_[number % images_.size()].file, info_.size, slot.data, slot.stride);
        item.frame = pool_.lend(slot, timeOf(number));
    } catch (const std::exception& e) {
        pool_.giveBack(slot);
        item.error = e.what();
    }
    return item;
}

RecordingPlayer::RecordingPlayer(Recording recording, const PlayerOptions& options)
    : recording_(std::move(recording)), timeline_(std::make_unique<Timeline>()),
      trigger_([this] { return now(); }) {
    if (options.videoBuffers < 2 || options.stillBuffers < 2)
        throw std::invalid_argument("a recording player needs at least two buffers per camera");
    const auto& video = recording_.video;
    const auto& stills = recording_.stills;
    Timestamp last = video.back().time;
    timeline_->pace = options.pace;
    timeline_->loop = options.loop;
    timeline_->asksVideoFirst = options.asksVideoFirst;
    timeline_->first = video.front().time;
    if (!stills.empty()) {
        timeline_->first = std::min(timeline_->first, stills.front().time);
        last = std::max(last, stills.back().time);
    }
    timeline_->lap = last - timeline_->first +
                     std::chrono::nanoseconds(std::llround(1e9 / recording_.videoRateHz));
    timeline_->nextVideo = timeline_->newestVideo = video.front().time;
    const std::string name = "recording " + recording_.root.string();
    video_ = std::make_unique<Stream>(*timeline_, video,
                                      CameraInfo{name + " video", recording_.rig.video.size,
                                                 PixelFormat::Rgba8, recording_.videoRateHz},
                                      true, options.videoBuffers);
    stills_ = std::make_unique<Stream>(
        *timeline_, stills,
        CameraInfo{name + " stills", recording_.rig.still.size, PixelFormat::Rgba8, 0}, false,
        options.stillBuffers);
}

RecordingPlayer::~RecordingPlayer() = default;

Camera& RecordingPlayer::video() {
    return *video_;
}

Camera& RecordingPlayer::stills() {
    return *stills_;
}

Timestamp RecordingPlayer::recordedTime(Timestamp played) const {
    if (!timeline_->loop || played < timeline_->first) return played;
    return timeline_->first + (played - timeline_->first) % timeline_->lap;
}

Timestamp RecordingPlayer::now() const {
    const std::lock_guard lock(timeline_->mutex);
    if (timeline_->pace == Pace::Consumer) return timeline_->newestVideo;
    if (!timeline_->begin) return timeline_->first;
    return timeline_->first + (Clock::now() - *timeline_->begin);
}

std::uint64_t RecordingPlayer::skipped() const {
    return video_->cameraCounters().missed.value_or(0);
}

}  // namespace mfar
