#pragma once

#include "daemon/tools/calibrate/target.h"
#include "daemon/tools/print/printed_page.h"
#include "pipeline/track/tag_family.h"

#include <span>
#include <string>

namespace mfar::print {

// The functions in this file return SVG documents. They throw std::runtime_error if a target does
// not fit on the paper; the message says what would fit.

/// Returns a page with tags. `size` is the distance between two adjacent corners of a tag [m]; see
/// TagFamilyInfo for the place of the corners. Throws std::runtime_error, too, if the family does
/// not contain an id, or if there is no id.
[[nodiscard]] std::string tagPage(TagFamily family, std::span<const int> ids, double size,
                                  const Paper& paper);

/// Returns a page with an AprilGrid: tags of family 36h11, and a black square at each corner of
/// each tag. Order and lengths are those of Kalibr's grids. The tags have borders of one cell;
/// Kalibr draws two.
[[nodiscard]] std::string gridPage(const calibration::Target& grid, const Paper& paper);

/// Returns a page with a checkerboard.
[[nodiscard]] std::string boardPage(const calibration::Target& board, const Paper& paper);

/// Return the largest edge of a tag or square with which the target fits on the paper, in whole mm
/// [m].
[[nodiscard]] double largestTag(int columns, int rows, double spacing, const Paper& paper);
[[nodiscard]] double largestSquare(int columns, int rows, const Paper& paper);

}  // namespace mfar::print
