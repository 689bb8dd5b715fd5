#pragma once

#include "base/time.h"
#include "pipeline/track/tag_family.h"

#include <Eigen/Core>

#include <filesystem>
#include <string_view>
#include <vector>

namespace mfar::calibration {

/// Largest number of tags or inner corners along a side of a target.
inline constexpr int kMostPerSide = 50;
/// Least number of corners in a view: fewer give no precise pose.
inline constexpr int kLeastViewCorners = 12;
/// Family of the tags of an AprilGrid.
inline constexpr const TagFamilyInfo& kGridFamily = info(TagFamily::Tag36h11);

enum class TargetKind { AprilGrid, Checkerboard };

/// A flat target whose corners can be identified. The origin of its frame is the first corner, and
/// the x axis is along a row. The y axis of an AprilGrid points up, as Kalibr defines it. The y
/// axis of a checkerboard is along a column. z is 0 for all corners.
struct Target {
    TargetKind kind = TargetKind::AprilGrid;
    int columns = 0, rows = 0;  ///< numbers of tags, or of a checkerboard's inner corners
    double size = 0;            ///< edge of a tag or of a square [m]
    double spacing = 0;         ///< gap between tags, divided by `size`
    int firstId = 0;
    /// Positions of all corners [m]. An AprilGrid has four corners per tag, counter-clockwise from
    /// the lower left.
    std::vector<Eigen::Vector3d> points;
};

/// Returns a target with tags of family 36h11. Their ids increase row by row from the lower left.
[[nodiscard]] Target aprilGrid(int columns, int rows, double tagSize, double spacing,
                               int firstId = 0);
/// Returns a checkerboard with `columns` x `rows` inner corners and squares of edge `square` [m].
/// One of the two numbers must be odd and the other even. Otherwise, the checkerboard would look
/// the same upside down. Throws std::runtime_error.
[[nodiscard]] Target checkerboard(int columns, int rows, double square);
/// `corners` are the numbers of inner corners, such as "9x6". Throws std::runtime_error.
[[nodiscard]] Target checkerboard(std::string_view corners, double square);
/// Throws std::runtime_error if an AprilGrid cannot have so many tags, or needs more.
void checkTagCount(int tags);
/// Parses Kalibr's description of an aprilgrid. Throws CalibrationError.
[[nodiscard]] Target readAprilGrid(const std::filesystem::path& file);

struct Corner {
    int index = 0;
    Eigen::Vector2d pixel;  ///< pixel centres have integer coordinates
};

struct TargetView {
    Timestamp time;
    std::vector<Corner> corners;
};

}  // namespace mfar::calibration
