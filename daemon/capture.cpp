#include "daemon/capture.h"

#include "daemon/budgets.h"
#include "daemon/exit_code.h"

#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

/// A working camera needs at most this time for stop(). The end of the process must not wait much
/// longer for a camera that hangs.
constexpr std::chrono::milliseconds kStopTime{100};

}  // namespace

CapturedFrame FramePairer::pair(Frame video, Timestamp arrived) {
    CapturedFrame paired{std::move(video), std::nullopt, arrived};
    for (;;) {
        if (!upcoming_) upcoming_ = nextStill_();
        if (!upcoming_ || upcoming_->frame.time() > paired.video.time()) return paired;
        if (paired.still) ++paired.stillsSuperseded;
        paired.still = *std::exchange(upcoming_, std::nullopt);
    }
}

CaptureThread::CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out)
    : rig_(rig), poses_(poses), stats_(stats), out_(out), video_(rig, CameraRole::Video, stats),
      still_(rig, CameraRole::Still, stats) {
    try {
        rig_.video().start();
        rig_.still().start();
    } catch (const std::runtime_error& error) {
        throw Failure(rig_.inputFailure(), error.what());
    }
    if (rig_.handOver() == HandOver::NewestWins) stills_.emplace(rig_, poses_, stats_);
    isOver_ = over_.get_future();
    thread_ = std::thread([this] { run(); });
}

CaptureThread::~CaptureThread() {
    stop();
    if (thread_.joinable()) thread_.join();
}

void CaptureThread::stop() {
    stopped_ = true;
    if (stills_) stills_->stop();
    rig_.still().stop();  // also sets the trigger line to its inactive level
    rig_.video().stop();
    out_.close();
}

void CaptureThread::join() {
    if (!thread_.joinable()) return;
    while (isOver_.wait_for(kStopTime) != std::future_status::ready)
        // If the capture thread still waits for a live camera, that camera may hang. So this
        // function finishes the recording itself and does not wait for the thread.
        if (rig_.handOver() == HandOver::NewestWins && video_.isWaiting())
            return rig_.finishRecording();
    thread_.join();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void CaptureThread::run() {
    try {
        Heartbeat heart(stats_.heartbeats(), "video capture", budget::kCapture);
        FramePairer pairer(stillSource());
        while (captureOne(pairer, heart))
            heart.beat();
    } catch (...) {
        failure_ = std::current_exception();
    }
    if (stills_) stills_->stop();
    out_.finish();
    // The capture thread finishes the recording here, while the picture thread still works on its
    // last picture. This shortens the shutdown.
    try {
        rig_.finishRecording();
    } catch (...) {
        if (!failure_) failure_ = std::current_exception();
    }
    over_.set_value();
}

FramePairer::NextStill CaptureThread::stillSource() {
    if (stills_) return [this] { return stills_->take(); };
    return [this] { return nextStill(still_, rig_, stats_, std::chrono::milliseconds(0)); };
}

bool CaptureThread::captureOne(FramePairer& pairer, Heartbeat& heart) {
    std::optional<Frame> video = video_.next(kFrameWait);
    // The capture thread reports faults, because the picture thread may be busy with one picture
    // for a while.
    stats_.fault(rig_.fault());
    if (stills_) stills_->check();
    if (!video) return !stopped_ && !video_.ended();
    const Timestamp arrived = Timestamp::now();
    // With a lossless source, the recorder may wait for a slow disk.
    if (rig_.handOver() == HandOver::Lossless) heart.restFor("the disk");
    rig_.recordVideo(*video);
    CapturedFrame captured = pairer.pair(std::move(*video), arrived);
    heart.beat();
    captured.pose = poses_.ofVideo(captured.video);
    if (captured.still) {
        CapturedStill& still = *captured.still;
        if (!still.measured) still.measured = poses_.measure(still.frame);
        still.pose = poses_.place(*still.measured, still.frame.time());
    }
    // Predicted poses and poses of stills are not recorded. When the recording is played,
    // Recording::poseAt() interpolates between the recorded poses.
    if (captured.pose && poses_.isRecordable(*captured.pose)) rig_.recordPose(*captured.pose);
    // With a lossless source, put() waits until this frame has been processed. This wait must not
    // count as a hanging thread.
    if (rig_.handOver() == HandOver::Lossless) heart.rest();
    const auto put = out_.put(std::move(captured));
    if (put == Mailbox<CapturedFrame>::Put::Replaced) stats_.mailboxDropped(out_.dropped());
    return put != Mailbox<CapturedFrame>::Put::Closed;
}

}  // namespace mfar
