#pragma once

#include <chrono>
#include <string_view>

namespace mfar {

/// How long threads may be silent, see Heartbeat. A thread on the way of the pictures that is
/// silent for longer hangs, and the watchdog is no longer fed.
namespace budget {

using std::chrono::milliseconds;

/// One picture of a camera, with its tags sought: 50 ms of waiting, 20 ms of work on a PC.
constexpr milliseconds kCapture{1500};
/// One picture, with a new still and the display.
constexpr milliseconds kPicture{2000};
/// One request, without the time that others need for the answer or a client to take it.
constexpr milliseconds kControl{500};
/// One event of the main thread.
constexpr milliseconds kMain{500};

/// systemd/mfard.service.in. Devices that are slow, but within these, must not add up to a process
/// that is ended: threads may wait for each other.
constexpr milliseconds kWatchdog{10'000};
static_assert(kCapture + kPicture + kControl + kMain < kWatchdog / 2);

/// Opening, stopping or closing a camera once, while other threads draw the banner and do not wait.
/// The driver of USB cameras waits 5 s for an answer, several times in a row.
constexpr milliseconds kOpener{20'000};

// Threads that the picture can do without.
/// Reads the configuration and models from files.
constexpr milliseconds kReload{60'000};
/// Waits for other threads and for the client, each of which is limited by itself.
constexpr milliseconds kAnswer{20'000};
/// A display's reader or disk takes one picture, else the display says who takes nothing.
constexpr milliseconds kTaken{2000};
/// Writes one picture to a file or pipe; a still of 12 megapixels takes 2 s on a small board.
constexpr milliseconds kWriter{10'000};
/// Learns from one still, in time that others leave.
constexpr milliseconds kLearning{60'000};

}  // namespace budget

/// The thread that makes pictures and shows them.
constexpr std::string_view kPictureThread = "picture";

/// A picture that has been shown for longer is stale.
constexpr std::chrono::milliseconds kStalePicture{3000};
/// Shaders are compiled for the first pictures, which may take all limits many times on a small
/// board.
constexpr int kFirstPatience = 6;

}  // namespace mfar
