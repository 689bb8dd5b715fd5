#pragma once

#include "base/geometry.h"
#include "base/time.h"
#include "hal/frame.h"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace mfar {

/// Thrown if a recording is invalid. The message is one line and begins with "file:line: " or
/// "file: ".
class RecordingError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RecordedImage {
    Timestamp time;
    std::filesystem::path file;
};

/// A recording in the EuRoC layout. Folder cam0 contains the video, cam1 the stills, each with
/// sensor.yaml and data.csv. All fields are validated. Pixels are read later, one picture at a
/// time.
struct Recording {
    std::filesystem::path root;
    StereoRig rig;
    double videoRateHz = 0;
    /// Time that the recording program added to the times of the stills, minus the time that it
    /// added to the times of the video [s]. Computed from time_offset in both sensor.yaml.
    double stillTimeOffset = 0;
    /// Video (never empty), stills and poses are sorted by time. No list contains a time twice.
    std::vector<RecordedImage> video;
    std::vector<RecordedImage> stills;
    std::vector<Pose> poses;

    /// Returns the pose at t, interpolated if necessary. Returns nothing if t is before the first
    /// pose, after the last pose, or in a gap of more than a quarter of a second.
    [[nodiscard]] std::optional<Pose> poseAt(Timestamp t) const;
    /// The following functions return the path of a file in truth/, or nothing if it is missing.
    [[nodiscard]] std::optional<std::filesystem::path> truthHighRes(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthInverseDepth(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthFlow(Timestamp from,
                                                                 Timestamp to) const;
};

/// Reads and validates a recording. Throws RecordingError if a file is missing, if a picture's size
/// differs from sensor.yaml, if times are not sorted or not unique, if a pose is not finite, or if
/// the lists need more than `most` bytes of memory.
[[nodiscard]] Recording loadRecording(const std::filesystem::path& root,
                                      std::size_t most = std::numeric_limits<std::size_t>::max());

[[nodiscard]] std::size_t memoryOf(const Recording& recording);

}  // namespace mfar
