#pragma once

#include "hal/camera.h"
#include "hal/trigger.h"
#include "hal/virtual/recording.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace mfar {

enum class Pace {
    Realtime,  ///< pictures are delivered at the intervals at which they were recorded
    Consumer,  ///< a picture is delivered as soon as it is requested; none is skipped
};

struct PlayerOptions {
    Pace pace = Pace::Realtime;
    bool loop = false;  ///< restart at the end; times still increase, see recordedTime()
    /// Number of buffers for pictures that are in use or decoded ahead, at least 2.
    int videoBuffers = 8;
    int stillBuffers = 4;
    /// For Pace::Consumer: the consumer requests a frame, and then the stills up to that frame.
    bool asksVideoFirst = false;
};

/// The trigger of a recording. It only counts its calls, because the stills are already recorded.
class RecordedTrigger final : public Trigger {
public:
    explicit RecordedTrigger(std::function<Timestamp()> now) : now_(std::move(now)) {}

    Timestamp fire() override {
        fired_.fetch_add(1, std::memory_order_relaxed);
        return now_();
    }
    [[nodiscard]] std::string name() const override {
        return "recording (stills arrive without a trigger)";
    }
    [[nodiscard]] std::uint64_t fired() const { return fired_.load(std::memory_order_relaxed); }

private:
    std::function<Timestamp()> now_;
    std::atomic<std::uint64_t> fired_{0};
};

/// Plays a recording as two cameras. Each has a thread that decodes a few pictures ahead. Each
/// camera can be started once and lives as long as the player; frames may outlive the player. If a
/// picture cannot be decoded, next() throws RecordingError, and the next call continues with the
/// following picture.
///
/// Pace::Realtime: both cameras share one clock, which begins with the first start(). If the next
/// video frame is already due, an older one that is still waiting is skipped and counted as missed,
/// just as a sensor overwrites unread frames. Stills are never skipped.
///
/// Pace::Consumer: stills().next() returns a still only if its time is not later than that of the
/// frame that video().next() will return next. So a thread that requests stills and frames
/// alternately gets all pictures in the order of their times, in every run. At equal times, the
/// still comes first. After the end of the video, any still is returned.
///
/// With `asksVideoFirst`, a still is returned only if its time is not later than that of the last
/// frame that video().next() returned (before the first frame: not later than that of the first
/// frame). This suits a thread that requests a frame and then the stills up to that frame. After
/// the end of the video, any still is returned.
///
/// With Pace::Consumer, next() waits for the decoder without a limit. Its timeout applies only
/// while the consumer holds all buffers, or while the next still must not be returned yet.
class RecordingPlayer {
public:
    RecordingPlayer(Recording recording, const PlayerOptions& options);
    RecordingPlayer(const RecordingPlayer&) = delete;
    RecordingPlayer& operator=(const RecordingPlayer&) = delete;
    ~RecordingPlayer();

    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& stills();
    [[nodiscard]] RecordedTrigger& trigger() { return trigger_; }
    [[nodiscard]] const Recording& recording() const { return recording_; }

    /// Converts the time of a delivered frame to the time in the recording's files. During the
    /// first pass through a recording, both are equal. During further passes (PlayerOptions::loop),
    /// the time of the delivered frame is later.
    [[nodiscard]] Timestamp recordedTime(Timestamp played) const;
    /// Returns the current time of the cameras. With Pace::Realtime, it is the time of their clock;
    /// otherwise it is the time of the last delivered video frame, or of the first frame if none
    /// was delivered yet.
    [[nodiscard]] Timestamp now() const;
    [[nodiscard]] std::uint64_t skipped() const;

private:
    struct Timeline;
    class Stream;

    Recording recording_;
    std::unique_ptr<Timeline> timeline_;
    std::unique_ptr<Stream> video_;
    std::unique_ptr<Stream> stills_;
    RecordedTrigger trigger_;
};

}  // namespace mfar
