#pragma once

#include "pipeline/track/tracker.h"

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mfar::eval {

struct KnownTag {
    int id = 0;
    std::array<Eigen::Vector2d, 4> corners;  ///< [px], pixel centres at integers
};

/// A photograph with the tags in it. The text has a line "id, (x y), (x y), (x y), (x y)" for each;
/// its coordinates have the middle of the first pixel at (0.5, 0.5), as libapriltag's.
struct TagPictureFile {
    std::filesystem::path image;
    std::vector<KnownTag> tags;
};

/// Sorted by name. Throws EvalError ("file:line: what") for a broken text, a text without a picture
/// and a folder without any.
[[nodiscard]] std::vector<TagPictureFile> tagPicturesOf(const std::filesystem::path& folder);

struct TagScore {
    double ms = 0;
    double cornerPx = 0;  ///< root mean square distance of the corners of the tags found
    int found = 0;        ///< same id, middle within half an edge
    int missed = 0;
    int wrong = 0;  ///< detections that are no known tag
};

/// How well the whole picture's search does: `detector`, and `refined` with the corners sharpened,
/// for which the picture's lens is taken as free of distortion. Families, decimation, threads and
/// gamma of the options.
[[nodiscard]] std::vector<std::pair<std::string, TagScore>>
compareTags(const TagPictureFile& picture, const TrackerOptions& options);

}  // namespace mfar::eval
