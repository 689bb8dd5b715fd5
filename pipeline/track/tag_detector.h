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
    int hamming = 0;    ///< number of corrected bits
    double margin = 0;  ///< mean difference between the data bits and their threshold [grey levels]
    /// Positions in the whole picture [px], with pixel centres at integers, in the order of
    /// kTagCorners: bottom left, bottom right, top right, top left of an upright tag seen from its
    /// front.
    std::array<Eigen::Vector2d, 4> corners;
};

/// Corners of a tag in its coordinates (origin in the centre, x right, y down, z into the surface),
/// in units of half the tag's size.
inline const std::array<Eigen::Vector2d, 4> kTagCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};

struct DetectorOptions {
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    /// Factor by which the picture is reduced for the search for quads: 1.5 or a whole number from
    /// 1 to 8. Bits and edges are read in the full picture.
    double decimation = 2;
    int threads = 1;
    double blur = 0;     ///< sigma of the blur before the search for quads [decimated px], 0 to 5
    bool refine = true;  ///< true: libapriltag moves the quad's edges to the strongest gradient
    /// Largest number of corrected bits of a detection, 0 or 1. tag16h5 is often found in noise, so
    /// its tags must have no corrected bit and at least twice minMargin.
    int maxHamming = 1;
    /// Width of the tags' black border [cells]: 2 for tags printed by Kalibr, otherwise 1.
    int borderCells = 1;
    double minMargin = 20;
};

/// Finds AprilTags with libapriltag. Only one thread at a time may use it.
class TagDetector {
public:
    explicit TagDetector(const DetectorOptions& options);
    ~TagDetector();
    TagDetector(TagDetector&&) noexcept;
    TagDetector& operator=(TagDetector&&) noexcept;

    /// Finds tags in a Gray8 picture of at most 32767x32767 pixels. The detections are sorted by
    /// tag, then from left to right. Throws std::invalid_argument if the format or the size is not
    /// supported.
    ///
    /// With `region`, only tags completely inside the region are found, exactly as in the whole
    /// picture: the region is clipped to the picture and enlarged to libapriltag's grid of tiles.
    [[nodiscard]] std::vector<TagDetection> detect(const ImageView& luma,
                                                   std::optional<PixelRect> region = {});

private:
    struct Library;
    std::unique_ptr<Library> library_;
    DetectorOptions options_;
    std::vector<unsigned char> copy_;
};

/// The black-and-white picture of a tag, with one pixel (0 or 255) per cell, including the white
/// border. Row 0 is at the top. `corner` is the number of cells from the picture's edge to the
/// tag's corners. drawTag() throws std::invalid_argument if the family does not have the id.
struct TagPicture {
    int size = 0;
    int corner = 0;
    std::vector<unsigned char> cells;
};
[[nodiscard]] TagPicture drawTag(TagKey tag);

}  // namespace mfar
