#pragma once

#include "hal/frame.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/synthetic_board.h"
#include "hal/virtual/synthetic_renderer.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

namespace mfar {

/// The thread of a SyntheticBoard. It owns a GL context, renders the pictures of both cameras and
/// controls the simulated time. Thread-safe.
class SyntheticStudio {
public:
    SyntheticStudio(const SyntheticOptions& options, const synthetic::World& world,
                    const StereoRig& rig);
    ~SyntheticStudio();
    SyntheticStudio(const SyntheticStudio&) = delete;
    SyntheticStudio& operator=(const SyntheticStudio&) = delete;

    void startVideo();
    void startStills();
    void stopVideo();
    void stopStills();
    [[nodiscard]] std::optional<Frame> nextVideo(std::chrono::milliseconds timeout);
    [[nodiscard]] std::optional<Frame> nextStill(std::chrono::milliseconds timeout);
    [[nodiscard]] bool videoEnded() const;
    [[nodiscard]] bool stillsEnded() const;
    Timestamp fire();
    /// Returns true from fire() until the still has been returned by nextStill().
    [[nodiscard]] bool isStillComing() const;

    /// Returns the picture of the video camera without noise, after waiting for the studio's
    /// thread. highRes() has the still's resolution and no blur.
    [[nodiscard]] StoredImage cleanVideo(Timestamp t);
    [[nodiscard]] StoredImage highRes(Timestamp t);

    [[nodiscard]] Timestamp epoch() const { return epoch_; }
    [[nodiscard]] double worldTime(Timestamp t) const { return secondsBetween(epoch_, t); }
    [[nodiscard]] Pose pose(Timestamp t) const;

private:
    struct Views;
    struct Still {
        Timestamp time;
        Timestamp available;
        std::optional<Frame> frame{};
    };
    enum class Work { Request, Video, Still, Quit };

    void run(std::promise<void>& ready);
    void serve(Views& views);
    [[nodiscard]] Work chooseWork(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] bool videoWanted() const;
    [[nodiscard]] bool videoAllMade() const;
    [[nodiscard]] bool videoDone() const;
    [[nodiscard]] bool stillWanted() const;
    [[nodiscard]] Timestamp now() const;
    [[nodiscard]] Timestamp videoTime(long long index) const;
    void makeVideo(Views& views);
    void stepStill(Views& views);
    [[nodiscard]] bool stillReady(bool mayWait) const;
    [[nodiscard]] StoredImage request(std::function<StoredImage(Views&)> make);
    [[nodiscard]] StoredImage picture(synthetic::SensorView& view, Timestamp t);
    void rethrowFailure() const;

    SyntheticOptions options_;
    synthetic::World world_;
    StereoRig rig_;
    Timestamp epoch_;
    FramePool videoPool_, stillPool_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool quit_ = false, videoOn_ = false, stillsOn_ = false;
    bool starved_ = false;
    /// True: a step of a still is rendered next. With Pace::Realtime, steps of stills and video
    /// frames alternate if both are due.
    bool stillsTurn_ = false;
    Timestamp start_;
    long long nextIndex_ = 0;
    int videoMade_ = 0;
    std::optional<Timestamp> handed_;
    std::optional<Timestamp> lastFire_;
    std::deque<Frame> video_;
    std::deque<Still> stills_;
    std::deque<std::packaged_task<StoredImage(Views&)>> requests_;
    std::exception_ptr failure_;
    /// Time of the still that is being rendered. Only thread_ uses it.
    std::optional<Timestamp> rendering_;
    std::thread thread_;
};

}  // namespace mfar
