#pragma once

#include "base/geometry.h"
#include "pipeline/track/tag_family.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

struct TagDetection {
    TagKey tag;
    int hamming = 0;    ///< number of bits of the tag's code that were corrected
    double margin = 0;  ///< mean difference between the data bits and their threshold [grey levels]
    /// Positions of the corners in the whole picture [px], with pixel centres at integers. Their
    /// order, seen from the front of an upright tag, is bottom left, bottom right, top right, top
    /// left. kTagCorners has the same corners in the tag's coordinates.
    std::array<Eigen::Vector2d, 4> corners;
};

/// The corners of a tag in its coordinates (origin in the centre, x right, y down, z into the
/// surface), in units of half the tag's size.
inline const std::array<Eigen::Vector2d, 4> kTagCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};

struct DetectorOptions {
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    /// Factor by which the picture is reduced for the search for quads. Bits and edges are read in
    /// the full picture. 1.5 or a whole number from 1 to 8.
    double decimation = 2;
    int threads = 1;     ///< number of threads, 1 to 64
    double blur = 0;     ///< sigma of the blur before the search for quads [decimated px], 0 to 5
    bool refine = true;  ///< whether libapriltag moves the quad's edges to the strongest gradient
    /// Largest number of corrected bits of a detection, 0 or 1. Tags of tag16h5 are often found in
    /// noise, so they must have no corrected bit and at least twice minMargin.
    int maxHamming = 1;
    /// Width of the tags' black border [cells], 1 or 2. Tags printed by Kalibr have a border of 2
    /// cells, all others of 1.
    int borderCells = 1;
    double minMargin = 20;  ///< smallest TagDetection::margin [grey levels]
};

/// Finds AprilTags with libapriltag. One thread at a time may use it.
class TagDetector {
public:
    /// Throws std::invalid_argument if an option is out of range, and std::runtime_error if the
    /// library is out of memory.
    explicit TagDetector(const DetectorOptions& options);
    ~TagDetector();
    TagDetector(TagDetector&&) noexcept;
    TagDetector& operator=(TagDetector&&) noexcept;

    /// Finds tags in a Gray8 picture of at most 32767x32767 pixels. The detections are sorted by
    /// tag, then from left to right.
    /// With `region`, only tags completely inside the region are found. The region is clipped to
    /// the picture and enlarged to libapriltag's grid of tiles, so that a tag is detected exactly
    /// as in the whole picture.
    /// Throws std::invalid_argument if the format or the size is not supported.
    [[nodiscard]] std::vector<TagDetection> detect(const ImageView& luma,
                                                   std::optional<PixelRect> region = {});

private:
    struct Library;
    std::unique_ptr<Library> library_;
    DetectorOptions options_;
    std::vector<unsigned char> copy_;  ///< used if libapriltag would blur its input in place
};

/// The black-and-white picture of a tag as libapriltag draws it, with one pixel per cell, including
/// the quiet zone. It has `size` x `size` values of 0 or 255, with row 0 at the top. `corner` is
/// the number of cells from the picture's edge to the tag's corners. drawTag() throws
/// std::invalid_argument if the family does not have the id.
struct TagPicture {
    int size = 0;
    int corner = 0;
    std::vector<unsigned char> cells;
};
[[nodiscard]] TagPicture drawTag(TagKey tag);

}  // namespace mfar
