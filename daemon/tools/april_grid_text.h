#pragma once

#include <fmt/format.h>

#include <string>

namespace mfar {

/// Kalibr's description of an AprilGrid. `size` is the edge of a tag [m], `spacing` the gap between
/// tags divided by `size`.
[[nodiscard]] inline std::string aprilGridText(int columns, int rows, double size, double spacing) {
    return fmt::format("target_type: 'aprilgrid'\ntagCols: {}\ntagRows: {}\n"
                       "tagSize: {}  # [m]\ntagSpacing: {}  # gap / tagSize\n",
                       columns, rows, size, spacing);
}

}  // namespace mfar
