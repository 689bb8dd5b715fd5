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
    Realtime,  ///< a picture comes as long after start() as it came after the recording's first
    Consumer,  ///< a picture comes as soon as it is asked for; none is ever left out
};

struct PlayerOptions {
    Pace pace = Pace::Realtime;
    bool loop = false;     ///< begin again at the end; times go on rising, see recordedTime()
    int videoBuffers = 8;  ///< pictures lent out and decoded ahead together, at least 2
    int stillBuffers = 4;  ///< the same for stills
    bool asksVideoFirst = false;  ///< of Pace::Consumer
};

/// A recorded still is one that somebody triggered then: firing counts and does nothing else.
class RecordedTrigger final : public Trigger {
public:
    explicit RecordedTrigger(std::function<Timestamp()> now) : now_(std::move(now)) {}

    Timestamp fire() override {
        fired_.fetch_add(1, std::memory_order_relaxed);
        return now_();
    }
    [[nodiscard]] std::string name() const override {
        return "recording (its stills come by themselves)";
    }
    [[nodiscard]] std::uint64_t fired() const { return fired_.load(std::memory_order_relaxed); }

private:
    std::function<Timestamp()> now_;
    std::atomic<std::uint64_t> fired_{0};
};

/// Plays a recording through two cameras, each with a thread that decodes a few pictures ahead.
/// Frames carry the times of the recording. The cameras live as long as the player and each can
/// be started once; frames may outlive the player. next() throws RecordingError for a picture that
/// cannot be decoded; the call after it goes on with the following picture.
///
/// Pace::Realtime: both cameras share one clock, which begins with the first start(). When
/// decoding or the consumer is so late that a later video picture is due already, the older one is
/// left out and counted, as a sensor overwrites what nobody fetched. Stills are never left out.
///
/// Pace::Consumer: stills().next() has a still exactly when its time is at or before the time of
/// the video picture that video().next() gives next (any still once all video is out). So one
/// thread that asks for a still, then for a video picture, in turn, sees all pictures in the order
/// of their times, stills first at equal times, in every run. With `asksVideoFirst` it has a still
/// at or before the picture that video().next() gave last: for a thread that asks for a video
/// picture, then for the stills that belong to it, and is not to wait for later ones. Waiting for
/// the decoder doesn't count as timeout here; waiting for a buffer that the consumer holds does.
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

    /// The time in the recording's files that a played time stands for; differs only in a loop.
    [[nodiscard]] Timestamp recordedTime(Timestamp played) const;
    /// How far playing has come, in played time: by the clock or by the newest video frame given.
    [[nodiscard]] Timestamp now() const;
    /// Video pictures left out because they were late.
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
