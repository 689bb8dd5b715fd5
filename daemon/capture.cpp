#include "daemon/capture.h"

#include "daemon/budgets.h"
#include "daemon/exit_code.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

/// How soon it is told that a camera sends nothing. stop() wakes the thread at once.
constexpr std::chrono::milliseconds kFrameWait{50};

}  // namespace

CapturedFrame FramePairer::pair(Frame video, Timestamp arrived) {
    CapturedFrame paired{std::move(video), std::nullopt, arrived};
    for (;;) {
        if (!upcoming_) upcoming_ = nextStill_();
        if (!upcoming_ || upcoming_->time() > paired.video.time()) return paired;
        paired.still = CapturedStill{*std::exchange(upcoming_, std::nullopt)};
    }
}

CaptureThread::CaptureThread(Rig& rig, PoseFinder& poses, Stats& stats, Mailbox<CapturedFrame>& out)
    : rig_(rig), poses_(poses), stats_(stats), out_(out) {
    try {
        rig_.video().start();
        rig_.still().start();
    } catch (const std::runtime_error& error) {
        throw Failure(rig_.inputFailure(), error.what());
    }
    thread_ = std::thread([this] { run(); });
}

CaptureThread::~CaptureThread() {
    stop();
    if (thread_.joinable()) thread_.join();
}

void CaptureThread::stop() {
    stopped_ = true;
    rig_.still().stop();  // with its trigger line, which nobody else would leave safe
    rig_.video().stop();
    out_.close();
}

void CaptureThread::join() {
    if (thread_.joinable()) thread_.join();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void CaptureThread::run() {
    try {
        Heartbeat heart(stats_.heartbeats(), "capture", budget::kCapture);
        const Size size = rig_.geometry().still.size;
        FramePairer pairer([&]() -> std::optional<Frame> {
            std::optional<Frame> still = take(rig_.still(), std::chrono::milliseconds(0), size);
            if (still) {
                still->shift(rig_.stillTimeOffset());
                stats_.stillReceived();
                rig_.recordStill(*still);
            }
            return still;
        });
        while (captureOne(pairer, heart))
            heart.beat();
    } catch (...) {
        failure_ = std::current_exception();
    }
    out_.finish();
    // Beside the last picture, for which a process in a hurry does not wait.
    try {
        rig_.finishRecording();
    } catch (...) {
        if (!failure_) failure_ = std::current_exception();
    }
}

bool CaptureThread::captureOne(FramePairer& pairer, Heartbeat& heart) {
    std::optional<Frame> video = take(rig_.video(), kFrameWait, rig_.geometry().video.size);
    // From here, as the GL thread may be busy with a picture for a while.
    stats_.fault(rig_.fault());
    if (!video) return !stopped_ && !rig_.video().ended();
    const Timestamp arrived = Timestamp::now();
    countGap(video->time());
    rig_.recordVideo(*video);
    CapturedFrame captured = pairer.pair(std::move(*video), arrived);
    captured.pose = poses_.ofVideo(captured.video);
    if (captured.still) captured.still->pose = poses_.ofStill(captured.still->frame);
    // What is only predicted, a replay predicts as well; a still's lies between those of the
    // frames.
    if (captured.pose && poses_.isMeasured(*captured.pose)) rig_.recordPose(*captured.pose);
    // It waits until the picture before is finished.
    if (rig_.handOver() == HandOver::Lossless) heart.rest();
    const auto put = out_.put(std::move(captured));
    if (put == Mailbox<CapturedFrame>::Put::Replaced) stats_.mailboxDropped(out_.dropped());
    return put != Mailbox<CapturedFrame>::Put::Closed;
}

std::optional<Frame> CaptureThread::take(Camera& camera, std::chrono::milliseconds timeout,
                                         Size expected) {
    std::optional<Frame> frame;
    try {
        frame = camera.next(timeout);
    } catch (const std::runtime_error& error) {
        throw Failure(rig_.inputFailure(), error.what());
    }
    if (!frame) return frame;
    const Size size = frame->view().size;
    if (size != expected)
        throw Failure(rig_.inputFailure(),
                      fmt::format("{}: sent a picture of {}x{}, calibrated are {}x{}",
                                  camera.info().name, size.width, size.height, expected.width,
                                  expected.height));
    return frame;
}

void CaptureThread::countGap(Timestamp time) {
    const double rate = rig_.video().info().rateHz;
    if (lastVideo_ && rate > 0 && rig_.handOver() == HandOver::NewestWins) {
        const double intervals = static_cast<double>((time - *lastVideo_).count()) * 1e-9 * rate;
        if (intervals > 1.5)
            stats_.videoGap(static_cast<std::uint64_t>(std::llround(intervals)) - 1);
    }
    lastVideo_ = time;
}

}  // namespace mfar
