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

/// A recording is invalid. The message begins with "file:line: " (or "file: " where no line is at
/// fault) and states the fault in one line.
class RecordingError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RecordedImage {
    Timestamp time;
    std::filesystem::path file;
};

/// A recording in the EuRoC layout: cam0 = video, cam1 = stills, both with sensor.yaml and
/// data.csv. All fields are validated; pixels are read later, one picture at a time.
struct Recording {
    std::filesystem::path root;
    StereoRig rig;
    double videoRateHz = 0;
    std::vector<RecordedImage> video;   ///< strictly increasing in time, never empty
    std::vector<RecordedImage> stills;  ///< strictly increasing in time, may be empty
    std::vector<Pose> poses;            ///< strictly increasing in time, may be empty

    /// Pose at exactly t or interpolated between its neighbours; empty outside the covered span and
    /// in gaps of more than a quarter of a second.
    [[nodiscard]] std::optional<Pose> poseAt(Timestamp t) const;
    /// Files in truth/; empty when missing.
    [[nodiscard]] std::optional<std::filesystem::path> truthHighRes(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthInverseDepth(Timestamp t) const;
    [[nodiscard]] std::optional<std::filesystem::path> truthFlow(Timestamp from,
                                                                 Timestamp to) const;
};

/// Reads and validates a recording: files exist, sizes agree with sensor.yaml (from the image
/// headers), times are sorted and unique, poses are finite. Throws RecordingError, also when the
/// lists take more than so many bytes of memory.
[[nodiscard]] Recording loadRecording(const std::filesystem::path& root,
                                      std::size_t most = std::numeric_limits<std::size_t>::max());

/// What the lists of a recording take, while they are read as well [byte].
[[nodiscard]] std::size_t memoryOf(const Recording& recording);

}  // namespace mfar
