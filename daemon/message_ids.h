#pragma once

#include <string>
#include <string_view>

namespace mfar {

/// Ids of messages in the journal. "journalctl MESSAGE_ID=..." finds all messages with an id,
/// whatever their texts are. The ids never change. All other messages have no id.
namespace message {

/// mfard is ready to make the first picture.
constexpr std::string_view kStarted = "4a32439137af4e3ca1cd6f7495cab2e2";
/// The process ended by force, e.g. without waiting for a device, or not all output was written.
constexpr std::string_view kEnded = "a08dca16247e4b149fdcdd335f72d624";
constexpr std::string_view kFailed = "6ce62346af964d0ca9101085e84bfb72";
constexpr std::string_view kReloaded = "672b6451eace4e6da3b559e91655d60e";
/// The configuration could not be read again; the previous one stays in use.
constexpr std::string_view kReloadRefused = "26fe80b3906a4c4ab98bf2b3510515af";
/// The health became Degraded. MFAR_CAMERA or MFAR_THREAD is set if a camera or thread is the
/// cause.
constexpr std::string_view kDegraded = "856eec9bc8cc4959b1e59e84282b63b9";
/// The health became Stalled. MFAR_THREAD is set if a thread hangs.
constexpr std::string_view kStalled = "0728b91900ba489c9f57c778157c86b8";
constexpr std::string_view kRecovered = "467a898a4b6148d88db37d31ed672b14";
/// A camera has a wrong frame rate, repeats a picture or has few buffers. MFAR_CAMERA names it.
constexpr std::string_view kCamera = "6d665cd9de5246c7b16ef1928c94a25f";
/// A triggered still did not arrive, or its exposure was not measured. MFAR_CAMERA names the
/// camera.
constexpr std::string_view kStill = "365758b84a734f5a930be01bd0adfb87";
/// The display has changed.
constexpr std::string_view kDisplay = "e94473ee2a28474dadb06e3c8109fe93";
/// A recording ended because of an error, or could not begin.
constexpr std::string_view kRecording = "06d9228be6854df8919fb89c868ca2f5";
/// Virtual objects are not shown as they are configured.
constexpr std::string_view kObjects = "ab773ad30eb64201b8fa0c9f9e80db7f";
/// The GPU failed. All objects on it were created again, or the CPU draws from now on.
constexpr std::string_view kGpu = "a50b5b6556864ca4a2fa3a55314a3733";
constexpr std::string_view kLearning = "a971f03ae21c4fdabf065e7fe8546f0b";

}  // namespace message

/// Fields of a journal message that describe its subject.
struct Subject {
    std::string_view id{};  ///< MESSAGE_ID, one of mfar::message; empty: no id
    std::string camera{};   ///< MFAR_CAMERA: "video", "still" or "video still"; empty: no camera
    std::string thread{};   ///< MFAR_THREAD: the thread that hangs; empty: no thread
};

}  // namespace mfar
