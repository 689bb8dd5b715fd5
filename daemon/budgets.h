#pragma once

#include <chrono>
#include <string_view>

namespace mfar {

/// Upper limits of the time between two heartbeats of a thread, see Heartbeat. A vital thread that
/// exceeds its budget hangs, and the watchdog is no longer fed.
namespace budget {

using std::chrono::milliseconds;

/// One picture of a camera, with the search for its tags: 50 ms of waiting, 20 ms of work on a PC.
constexpr milliseconds kCapture{1500};
/// One picture, with a new still and the display.
constexpr milliseconds kPicture{2000};
/// One request, without the time in which other threads make the answer or the client takes it.
constexpr milliseconds kControl{500};
/// One event of the main thread.
constexpr milliseconds kMain{500};

/// WatchdogSec= of systemd/mfard.service.in. Devices that are slow, but within their budgets, must
/// not add up to a watchdog timeout: threads may wait for each other.
constexpr milliseconds kWatchdog{10'000};
static_assert(kCapture + kPicture + kControl + kMain < kWatchdog / 2);

/// Opening, stopping or closing a camera once; other threads draw the banner meanwhile. The driver
/// of USB cameras waits 5 s for an answer, several times in a row.
constexpr milliseconds kOpener{20'000};

// Threads that pictures can be made without.
/// Reads the configuration and models from files.
constexpr milliseconds kReload{60'000};
/// Waits for other threads and for the client, which both have limits of their own.
constexpr milliseconds kAnswer{20'000};
/// A display's reader or disk takes one picture; a longer wait is reported by the display.
constexpr milliseconds kTaken{2000};
/// Writes one picture to a file or pipe; a still of 12 megapixels takes 2 s on a small board.
constexpr milliseconds kWriter{10'000};
/// Learns from one still, in the time that other threads leave.
constexpr milliseconds kLearning{60'000};

}  // namespace budget

/// The thread that makes pictures and shows them.
constexpr std::string_view kPictureThread = "picture";

/// A displayed picture older than this is stale.
constexpr std::chrono::milliseconds kStalePicture{3000};
/// Factor on all limits for the first pictures, for which shaders are compiled: slow on a small
/// board.
constexpr int kFirstPatience = 6;

}  // namespace mfar
