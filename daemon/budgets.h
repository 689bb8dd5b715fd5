#pragma once

#include <chrono>
#include <string_view>

namespace mfar {

/// Longest allowed times between two heartbeats of a thread, see Heartbeat. If a vital thread
/// exceeds its budget, it counts as hanging, and the watchdog is not fed any more.
namespace budget {

using std::chrono::milliseconds;

/// One frame of a camera and the search for tags in it. It takes 50 ms of waiting and 20 ms of work
/// on a PC.
constexpr milliseconds kCapture{1500};
/// Processing and showing one picture, including a new still.
constexpr milliseconds kPicture{2000};
/// Reading one request of mfarctl, without the time for its answer.
constexpr milliseconds kControl{500};
/// Handling one event of the main thread.
constexpr milliseconds kMain{500};

/// WatchdogSec= of systemd/mfard.service.in. Threads may wait for each other, so the sum of the
/// budgets must be less than this. Otherwise slow devices could cause a watchdog timeout.
constexpr milliseconds kWatchdog{10'000};
static_assert(kCapture + kPicture + kControl + kMain < kWatchdog / 2);

/// Opening, stopping or closing a camera once. Other threads show the banner in the meantime. The
/// driver of USB cameras waits 5 s for an answer, several times in a row.
constexpr milliseconds kOpener{20'000};

// Pictures can be made without the following threads.
/// Reading the configuration and models from files.
constexpr milliseconds kReload{60'000};
/// Answering one request of mfarctl. The waits for other threads and the client have shorter
/// limits.
constexpr milliseconds kAnswer{20'000};
/// Longest time in which a display's reader or disk accepts one picture. The display reports more.
constexpr milliseconds kTaken{2000};
/// Writing one picture to a file or pipe. A still of 12 megapixels takes 2 s on a small board.
constexpr milliseconds kWriter{10'000};
/// Learning from one still, at low priority.
constexpr milliseconds kLearning{60'000};

}  // namespace budget

/// Name of the thread that makes pictures and shows them.
constexpr std::string_view kPictureThread = "picture";

/// A displayed picture older than this is stale.
constexpr std::chrono::milliseconds kStalePicture{3000};
/// Factor of all time limits for the first pictures. Shaders are compiled for these, which is slow
/// on a small board.
constexpr int kFirstPatience = 6;

}  // namespace mfar
