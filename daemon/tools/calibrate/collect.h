#pragma once

#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/solve.h"
#include "hal/virtual/recording.h"

#include <functional>

namespace mfar::calibration {

struct Progress {
    const Coverage& coverage;
    /// Numbers of pictures. `done`: searched so far. `of`: to be searched in total. `found`: those
    /// of `done` that show the target.
    int done = 0, of = 0, found = 0;
};

/// Searches for the target in all pictures of one sensor. `progress` is called after each picture.
/// Throws ImageFileError.
[[nodiscard]] SensorViews collect(const std::vector<RecordedImage>& pictures, Size picture,
                                  const Target& target,
                                  const std::function<void(const Progress&)>& progress);

}  // namespace mfar::calibration
