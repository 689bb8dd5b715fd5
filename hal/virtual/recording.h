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

/// Reports that a recording is invalid. The message states the fault in one line. It begins with
/// "file:line: ", or with "file: " if the fault has no line.
class RecordingError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RecordedImage {
    Timestamp time;
    std::filesystem::path file;
};

/// A recording in the EuRoC layout. Folder cam0 contains the video, cam1 the stills. Each has a
/// sensor.yaml and a data.csv. All fields are validated. The pixels of the pictures are read later,
/// one picture at a time.
struct Recording {
    std::filesystem::path root;
    StereoRig rig;
    double videoRateHz = 0;
    std::vector<RecordedImage> video;   ///< sorted by time; times differ; never empty
    std::vector<RecordedImage> stills;  ///< sorted by time; times differ; may be empty
    std::vector<Pose> poses;            ///< sorted by time; times differ; may be empty

    /// Returns the pose at t, interpolated if necessary. Returns nothing if t is before the first
    /// pose, after the last pose, or in a gap of more than a quarter of a second.
    [[nodiscard]] std::optional<Pose> poseAt(Timestamp t) const;
    /// The following functions return the path of a file in truth/, or nothing if it is missing.
    [[nodiscard]] std::optional<std::filesystem::path> truthHighRes(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthInverseDepth(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthFlow(Timestamp from,
                                                                 Timestamp to) const;
};

/// Reads and validates a recording. The files must exist, the sizes in their headers must agree
/// with sensor.yaml, the times must be sorted and unique, and the poses must be finite. Otherwise
/// throws RecordingError. Also throws if the lists need more than `most` bytes of memory.
[[nodiscard]] Recording loadRecording(const std::filesystem::path& root,
                                      std::size_t most = std::numeric_limits<std::size_t>::max());

/// Returns the largest number of bytes that the lists of a recording need, even while they are
/// read.
[[nodiscard]] std::size_t memoryOf(const Recording& recording);

}  // namespace mfar
