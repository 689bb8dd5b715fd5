#pragma once

#include "daemon/config.h"
#include "hal/virtual/recording.h"

namespace mfar {

enum class RecordingCheck {
    Folder,  ///< the recording's folder must exist
    Lists,   ///< the recording's lists must be valid, too; this takes time for long recordings
};

/// Checks the files, apart from models and pictures, that a run with this configuration reads
/// before its first frame: calibration, tag map, quality levels and recording. Also checks the
/// memory for the pictures of the source. Throws Failure with all faults; each begins with the
/// place of its key, see Config::places. The exit code of the Failure is that of the first fault.
void requireFiles(const Config& config, RecordingCheck check);

/// Throws Failure if pictures of the cameras or of the simulated board need more memory than
/// [limits] memory_mb allows.
void requireSourceMemory(const Config& config);

/// Loads the recording of the configuration. Throws Failure if it is missing, invalid or too large.
[[nodiscard]] Recording recordingOf(const Config& config);

}  // namespace mfar
