#pragma once

#include "base/calibration/rig_files.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <string>

namespace mfar::test {

inline RigCalibration sampleRig() {
    RigCalibration out;
    out.rig.video = {{640, 480}, 560.4, 560.9, 321.7, 237.6, {-0.115, 0.062, 0.0006, -0.0005, 0}};
    out.rig.still = {{2304, 1728}, 1962.0, 1963.5, 1158.2, 857.4, {-0.072, 0.031, -0.0004, 0.0007}};
    Eigen::Matrix3d r;
    r << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1;
    out.rig.T_still_video = {Eigen::Quaterniond(r), {-0.014, 0.001, 0.0005}};
    out.stillTimeOffset = 0.0025;
    return out;
}

inline const char* const kKalibrText = R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.115, 0.062, 0.0006, -0.0005]
  distortion_model: radtan
  intrinsics: [560.4, 560.9, 321.7, 237.6]
  resolution: [640, 480]
  rostopic: /video
  timeshift_cam_imu: 0.001
cam1:
  T_cn_cnm1:
  - [0.8, -0.6, 0.0, -0.014]
  - [0.6, 0.8, 0.0, 0.001]
  - [0.0, 0.0, 1.0, 0.0005]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.072, 0.031, -0.0004, 0.0007]
  distortion_model: radtan
  intrinsics: [1962.0, 1963.5, 1158.2, 857.4]
  resolution: [2304, 1728]
  rostopic: /still
  timeshift_cam_imu: 0.0035
)";

inline const char* const kOpenCvIntrinsics = R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 560.4, 0., 321.7, 0., 560.9, 237.6, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.115, 0.062, 0.0006, -0.0005, 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1962., 0., 1158.2, 0., 1963.5, 857.4, 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.072, 0.031, -0.0004, 0.0007, 0. ]
)";

inline const char* const kOpenCvExtrinsics = R"(%YAML:1.0
---
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 8.0e-01, -6.0e-01, 0., 6.0e-01, 8.0e-01, 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.014, 0.001, 0.0005 ]
)";

inline std::string openCvText() {
    // substr() removes the header, because a document must have only one.
    return kOpenCvIntrinsics + std::string(kOpenCvExtrinsics).substr(14) +
           "image_size1: [ 640, 480 ]\nimage_size2: [ 2304, 1728 ]\n";
}

}  // namespace mfar::test
