#pragma once

#include "base/time.h"

#include <Eigen/Core>

#include <filesystem>
#include <string_view>
#include <vector>

/// The solver behind mfar-calibrate.
namespace mfar::calibration {

enum class TargetKind { AprilGrid, Checkerboard };

/// A flat target with distinguishable corners. Target frame: origin at the first corner, x along a
/// row, y upwards (AprilGrid, as Kalibr's) or along a column (checkerboard), z = 0.
struct Target {
    TargetKind kind = TargetKind::AprilGrid;
    int columns = 0, rows = 0;            ///< tags, or inner corners
    double size = 0;                      ///< edge of a tag or of a square [m]
    double spacing = 0;                   ///< gap between tags / size
    int firstId = 0;                      ///< id of the first tag
    std::vector<Eigen::Vector3d> points;  ///< [m] of every corner; AprilGrid: four to a tag, from
                                          ///< its lower left one counter-clockwise
};

/// Tags of family 36h11, ids row by row from the lower left.
[[nodiscard]] Target aprilGrid(int columns, int rows, double tagSize, double spacing,
                               int firstId = 0);
/// `columns` x `rows` inner corners, one number odd and the other even: otherwise the board looks
/// the same upside down. Throws std::runtime_error.
[[nodiscard]] Target checkerboard(int columns, int rows, double square);
/// Parses "9x6"; with the square's edge [m]. Throws std::runtime_error.
[[nodiscard]] Target checkerboard(std::string_view corners, double square);
/// Parses Kalibr's description of an aprilgrid. Throws CalibrationError.
[[nodiscard]] Target readAprilGrid(const std::filesystem::path& file);

/// A corner of the target found in a picture.
struct Corner {
    int index = 0;          ///< into Target::points
    Eigen::Vector2d pixel;  ///< [px], pixel centres at integers
};

/// The corners found in one picture.
struct TargetView {
    Timestamp time;
    std::vector<Corner> corners;
};

}  // namespace mfar::calibration
