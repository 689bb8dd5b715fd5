#pragma once

#include "base/calibration/rig_files.h"
#include "base/calibration/yaml_reader.h"

/// Functions that read the file formats of loadRig(). All throw CalibrationError.
namespace mfar::rig_formats {

[[nodiscard]] RigCalibration kalibr(const YamlReader& in, const WantedSizes& wanted);

[[nodiscard]] bool isOpenCv(const YamlReader& in);
[[nodiscard]] RigCalibration openCv(const YamlReader& intrinsics, const YamlReader& extrinsics,
                                    const WantedSizes& wanted);

}  // namespace mfar::rig_formats
