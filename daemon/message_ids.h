#pragma once

#include <string>
#include <string_view>

namespace mfar {

/// Ids of the messages in the journal, one for each kind: "journalctl MESSAGE_ID=..." finds all
/// messages of a kind, whatever their wording. They never change. Messages of other kinds have no
/// id.
namespace message {

/// The first picture can be made: mfard is ready.
constexpr std::string_view kStarted = "4a32439137af4e3ca1cd6f7495cab2e2";
/// The process ends on request or by itself, perhaps without waiting for a device.
constexpr std::string_view kEnded = "a08dca16247e4b149fdcdd335f72d624";
/// The error that ended the process.
constexpr std::string_view kFailed = "6ce62346af964d0ca9101085e84bfb72";
/// The configuration was read again.
constexpr std::string_view kReloaded = "672b6451eace4e6da3b559e91655d60e";
/// The configuration could not be read again; the previous one stays in use.
constexpr std::string_view kReloadRefused = "26fe80b3906a4c4ab98bf2b3510515af";
/// Health became Degraded; MFAR_CAMERA, MFAR_THREAD where one of them is the cause.
constexpr std::string_view kDegraded = "856eec9bc8cc4959b1e59e84282b63b9";
/// Health became Stalled; MFAR_THREAD where a thread hangs.
constexpr std::string_view kStalled = "0728b91900ba489c9f57c778157c86b8";
/// Health became Ok again.
constexpr std::string_view kRecovered = "467a898a4b6148d88db37d31ed672b14";
/// A camera's rate is wrong, it repeats pictures or has few buffers; MFAR_CAMERA.
constexpr std::string_view kCamera = "6d665cd9de5246c7b16ef1928c94a25f";
/// A triggered still has not come, or its exposure is unverified; MFAR_CAMERA.
constexpr std::string_view kStill = "365758b84a734f5a930be01bd0adfb87";
/// The display has changed.
constexpr std::string_view kDisplay = "e94473ee2a28474dadb06e3c8109fe93";
/// A recording has ended because of an error, or could not begin.
constexpr std::string_view kRecording = "06d9228be6854df8919fb89c868ca2f5";
/// Virtual objects are not shown as configured.
constexpr std::string_view kObjects = "ab773ad30eb64201b8fa0c9f9e80db7f";
/// The GPU failed: everything on it was created again, or the CPU draws from now on.
constexpr std::string_view kGpu = "a50b5b6556864ca4a2fa3a55314a3733";
/// Learned filters could not be read or written.
constexpr std::string_view kLearning = "a971f03ae21c4fdabf065e7fe8546f0b";

}  // namespace message

/// Journal fields that describe the subject of a message.
struct Subject {
    std::string_view id{};  ///< MESSAGE_ID, of mfar::message; empty: no id
    std::string camera{};   ///< MFAR_CAMERA: "video", "still" or both; empty: no camera
    std::string thread{};   ///< MFAR_THREAD: the thread that hangs; empty: no thread
};

}  // namespace mfar
