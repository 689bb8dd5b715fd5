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

/// A photograph that shows tags. Its text file has a line "id, (x y), (x y), (x y), (x y)" for each
/// tag; the centre of the first pixel is at (0.5, 0.5), as in libapriltag.
struct TagPictureFile {
    std::filesystem::path image;
    std::vector<KnownTag> tags;
};

/// Sorted by name. Throws EvalError ("file:line: what") for a faulty text, a text without a picture
/// and a folder without pictures.
[[nodiscard]] std::vector<TagPictureFile> tagPicturesOf(const std::filesystem::path& folder);

struct TagScore {
    double ms = 0;
    double cornerPx = 0;  ///< root mean square distance of the found tags' corners
    int found = 0;        ///< same id, centre within half an edge
    int missed = 0;
    int wrong = 0;  ///< detections that are not known tags
};

/// Scores of the search in the whole picture: `detector`, and `refined` with refined corners, for
/// which the lens is assumed to be free of distortion. Uses families, decimation, threads and gamma
/// of the options.
[[nodiscard]] std::vector<std::pair<std::string, TagScore>>
compareTags(const TagPictureFile& picture, const TrackerOptions& options);

}  // namespace mfar::eval
