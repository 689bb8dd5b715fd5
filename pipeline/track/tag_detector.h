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
    /// Positions of the corners in the whole picture [px]; pixel centres are at integers. The order
    /// is that of kTagCorners: bottom left, bottom right, top right, top left, as seen from the
    /// front of an upright tag.
    std::array<Eigen::Vector2d, 4> corners;
};

/// Corners of a tag in tag coordinates. The unit is half the tag's size. The origin is in the
/// centre; x points right, y down, and z into the surface.
inline const std::array<Eigen::Vector2d, 4> kTagCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};

struct DetectorOptions {
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    /// For the search for quads, the picture is reduced by this factor: 1.5 or a whole number from
    /// 1 to 8. Bits and edges are read in the full picture.
    double decimation = 2;
    int threads = 1;     ///< 1 to 64
    double blur = 0;     ///< sigma of the blur before the search for quads [decimated px], 0 to 5
    bool refine = true;  ///< true: libapriltag moves the quad's edges to the strongest gradient
    /// Largest number of corrected bits of a detection, 0 or 1. Tags of tag16h5 are often found in
    /// noise. They must therefore have no corrected bit, and a margin of at least twice minMargin.
    int maxHamming = 1;
    /// Width of the tags' black border [cells]: 2 for tags printed by Kalibr, otherwise 1.
    int borderCells = 1;
    double minMargin = 20;  ///< smallest TagDetection::margin of a detection, 0 to 255
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
    /// The region is clipped to the picture and enlarged to whole tiles of libapriltag, so that
    /// tags are found exactly as in the whole picture. Only tags completely inside the enlarged
    /// region are found. Nothing is found in a region or picture with a side shorter than 16
    /// decimated pixels.
    [[nodiscard]] std::vector<TagDetection> detect(const ImageView& luma,
                                                   std::optional<PixelRect> region = {});

private:
    struct Library;
    std::unique_ptr<Library> library_;
    DetectorOptions options_;
    std::vector<unsigned char> copy_;
};

/// The black-and-white picture of a tag, including the white border. There is one pixel (0 or 255)
/// per cell, and row 0 is at the top. `corner` is the number of cells from the picture's edge to
/// the tag's corners. drawTag() throws std::invalid_argument if the family does not contain the id.
struct TagPicture {
    int size = 0;
    int corner = 0;
    std::vector<unsigned char> cells;
};
[[nodiscard]] TagPicture drawTag(TagKey tag);

}  // namespace mfar
