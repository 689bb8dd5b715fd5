#pragma once

#include <chrono>
#include <string_view>

namespace mfar {

/// The time budget of each thread: the longest allowed time between two heartbeats, see Heartbeat.
/// If a vital thread exceeds its budget, it counts as hanging, and systemd's watchdog is not fed
/// any more.
namespace budget {

using std::chrono::milliseconds;

/// Each capture thread: fetching one frame of its camera, and searching it for tags. On a PC, this
/// takes up to 50 ms of waiting (kFrameWait) and 20 ms of work.
constexpr milliseconds kCapture{1500};
constexpr milliseconds kPicture{2000};
/// Thread of the control socket: reading one request of mfarctl. Waiting for the answer does not
/// count.
constexpr milliseconds kControl{500};
constexpr milliseconds kMain{500};

/// systemd restarts mfard if the watchdog is not fed for this time, see WatchdogSec= in
/// systemd/mfard.service.in. The threads whose budgets are added below may wait for each other, so
/// the sum must be less than half of this time.
constexpr milliseconds kWatchdog{10'000};
static_assert(kCapture + kPicture + kControl + kMain < kWatchdog / 2);

/// Thread of a camera: opening, stopping or closing the camera once. This may take long, because
/// the driver of a USB camera may wait 5 s for an answer, several times in a row. Pictures with a
/// banner are shown meanwhile.
constexpr milliseconds kOpener{20'000};

// If one of the following threads hangs, pictures can still be made.
/// Reload thread: reading the configuration and models from files.
constexpr milliseconds kReload{60'000};
/// Answer thread: answering one request of mfarctl. The longest wait is at the beginning or end of
/// a recording, for the disk. mfarctl waits as long.
constexpr milliseconds kAnswer{600'000};
/// Time that one picture may wait for the disk, or for the reader of the display's pipe. A longer
/// wait is reported as a fault of the display.
constexpr milliseconds kTaken{2000};
/// Writer thread: writing one picture to a file or pipe. A still of 12 megapixels takes 2 s on a
/// small board.
constexpr milliseconds kWriter{10'000};
constexpr milliseconds kLearning{60'000};

}  // namespace budget

constexpr std::string_view kPictureThread = "picture";

/// A picture that was shown longer ago than this does not count as recent. For slow cameras, the
/// limit is longer, see health.cpp.
constexpr std::chrono::milliseconds kStalePicture{3000};
/// While the first pictures are made, time limits are multiplied by this factor, because compiling
/// shaders is slow on a small board. These limits are: the budgets of all threads, kStalePicture
/// and the timeout of systemd's watchdog.
constexpr int kFirstPatience = 6;

}  // namespace mfar
