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
    /// A picture is due as long after start() as it came after the recording's first picture.
    Realtime,
    Consumer,  ///< a picture is delivered as soon as it is requested; none is skipped
};

struct PlayerOptions {
    Pace pace = Pace::Realtime;
    bool loop = false;            ///< restart at the end; times keep increasing, see recordedTime()
    int videoBuffers = 8;         ///< pictures lent and decoded ahead together, at least 2
    int stillBuffers = 4;         ///< as videoBuffers, for stills
    bool asksVideoFirst = false;  ///< only for Pace::Consumer
};

/// Trigger of a recording, whose stills were triggered when it was made: only counts.
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

/// Plays a recording through two cameras, each with a thread that decodes a few pictures ahead.
/// Frames carry the recording's times. The cameras live as long as the player and each can be
/// started once; frames may outlive the player. next() throws RecordingError for a picture that
/// cannot be decoded; the next call continues with the following picture.
///
/// Pace::Realtime: both cameras share one clock, which begins with the first start(). When decoding
/// or the consumer is so late that a later video picture is already due, the older one is skipped
/// and counted, as a sensor overwrites unread pictures. Stills are never skipped.
///
/// Pace::Consumer: stills().next() returns a still exactly when its time is at or before that of
/// the video picture that video().next() returns next (any still once the video has ended). So a
/// thread that alternately requests a still and a video picture gets all pictures in the order of
/// their times, stills first at equal times, in every run. With `asksVideoFirst`, a still is
/// returned at or before the last picture that video().next() returned: for a thread that requests
/// a video picture and then its stills, without waiting for later ones. Waiting for the decoder
/// does not count for the timeout; waiting for a buffer that the consumer holds does.
class RecordingPlayer {
public:
    /// Throws std::invalid_argument when the options are impossible.
    RecordingPlayer(Recording recording, const PlayerOptions& options);
    RecordingPlayer(const RecordingPlayer&) = delete;
    RecordingPlayer& operator=(const RecordingPlayer&) = delete;
    ~RecordingPlayer();

    [[nodiscard]] Camera& video();
    [[nodiscard]] Camera& stills();
    [[nodiscard]] RecordedTrigger& trigger() { return trigger_; }
    [[nodiscard]] const Recording& recording() const { return recording_; }

    /// Converts a played time to the time in the recording's files; they differ only in a loop.
    [[nodiscard]] Timestamp recordedTime(Timestamp played) const;
    /// Current played time: from the clock or from the newest delivered video frame.
    [[nodiscard]] Timestamp now() const;
    /// Number of late video pictures that were skipped.
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
