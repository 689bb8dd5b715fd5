#include "daemon/still_thread.h"

#include "base/heartbeats.h"
#include "daemon/budgets.h"

#include <utility>

namespace mfar {

std::optional<CapturedStill> nextStill(CameraReader& reader, Rig& rig, Stats& stats,
                                       std::chrono::milliseconds timeout) {
    std::optional<Frame> still = reader.next(timeout);
    if (!still) return std::nullopt;
    still->shift(rig.stillTimeOffset());
    stats.stillReceived(still->time());
    rig.recordStill(*still);
    return CapturedStill{*std::move(still)};
}

bool StillBox::put(CapturedStill still) {
    // `oldest` is declared before `lock`, so it is destroyed after the mutex was unlocked.
    std::optional<CapturedStill> oldest;
    const std::lock_guard lock(mutex_);
    if (stills_.size() == kCapacity) {
        oldest = std::move(stills_.front());
        stills_.pop_front();
    }
    stills_.push_back(std::move(still));
    return !oldest;
}

std::optional<CapturedStill> StillBox::take() {
    const std::lock_guard lock(mutex_);
    if (stills_.empty()) return std::nullopt;
    std::optional<CapturedStill> still = std::move(stills_.front());
    stills_.pop_front();
    return still;
}

StillThread::StillThread(Rig& rig, PoseFinder& poses, Stats& stats)
    : rig_(rig), poses_(poses), stats_(stats), reader_(rig, CameraRole::Still, stats),
      thread_([this] { run(); }) {}

StillThread::~StillThread() {
    stop();
    thread_.join();
}

void StillThread::check() const {
    if (failed_) std::rethrow_exception(failure_);
}

void StillThread::run() {
    try {
        // The role of this thread is Helper, because pictures can be made even if no new stills
        // arrive.
        Heartbeat heart(stats_.heartbeats(), "still capture", budget::kCapture, ThreadRole::Helper);
        while (!stopped_ && !reader_.ended()) {
            heart.beat();
            std::optional<CapturedStill> still = nextStill(reader_, rig_, stats_, kFrameWait);
            if (!still) continue;
            still->measured = poses_.measure(still->frame);
            if (!box_.put(*std::move(still))) stats_.stillsSuperseded(1);
        }
    } catch (...) {
        failure_ = std::current_exception();
        failed_ = true;
    }
}

}  // namespace mfar
