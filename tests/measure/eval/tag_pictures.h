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
    std::array<Eigen::Vector2d, 4> corners;  ///< [px]; pixel centres are integers
};

/// A photograph and the tags that it shows. Its text file has one line "id, (x y), (x y), (x y), (x
/// y)" per tag. In the text file, as in libapriltag, the centre of the first pixel is (0.5, 0.5).
struct TagPictureFile {
    std::filesystem::path image;
    std::vector<KnownTag> tags;
};

/// Photographs of a folder, sorted by name. Throws EvalError for a faulty text file ("file:line:
/// what") and for a folder without pictures.
[[nodiscard]] std::vector<TagPictureFile> tagPicturesOf(const std::filesystem::path& folder);

struct TagScore {
    double ms = 0;
    double cornerPx = 0;
    /// Number of known tags that were found with the right id and with a centre that is off by less
    /// than half an edge.
    int found = 0;
    int missed = 0;
    int wrong = 0;
};

/// Returns two named scores of the tags that are found in the whole picture: "detector", with the
/// detector's corners, and "refined", with corners that are refined as if the lens had no
/// distortion. Uses families, decimation, threads and gamma of the options.
[[nodiscard]] std::vector<std::pair<std::string, TagScore>>
compareTags(const TagPictureFile& picture, const TrackerOptions& options);

}  // namespace mfar::eval
