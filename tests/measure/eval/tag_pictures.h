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

/// A photograph that shows tags, and its true tags. Its text file has one line "id, (x y), (x y),
/// (x y), (x y)" per tag. As in libapriltag, the centre of the first pixel is at (0.5, 0.5).
struct TagPictureFile {
    std::filesystem::path image;
    std::vector<KnownTag> tags;
};

/// The photographs of a folder, sorted by name. Throws EvalError ("file:line: what") for a faulty
/// text file, for a text file without a picture and for a folder without pictures.
[[nodiscard]] std::vector<TagPictureFile> tagPicturesOf(const std::filesystem::path& folder);

struct TagScore {
    double ms = 0;
    double cornerPx = 0;  ///< root mean square error of the corners of found tags
    int found = 0;        ///< tags found: same id, centre closer than half an edge
    int missed = 0;
    int wrong = 0;  ///< detections that match none of the known tags
};

/// Scores of the tags that are found in the whole picture, under two names. `detector`: with the
/// detector's corners; `refined`: with corners that are refined as if the lens had no distortion.
/// Uses families, decimation, threads and gamma of the options.
[[nodiscard]] std::vector<std::pair<std::string, TagScore>>
compareTags(const TagPictureFile& picture, const TrackerOptions& options);

}  // namespace mfar::eval
