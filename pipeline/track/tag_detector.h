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
    int hamming = 0;    ///< corrected bits
    double margin = 0;  ///< mean contrast of the data bits to their threshold [grey levels]
    /// [px] in the whole picture, pixel centres at integers. Order, seen from the front of an
    /// upright tag: bottom left, bottom right, top right, top left; kTagCorners has them in the
    /// tag's frame.
    std::array<Eigen::Vector2d, 4> corners;
};

/// Corners in the tag's frame (origin in the middle, x right, y down, z into the surface) in units
/// of half the tag's size.
inline const std::array<Eigen::Vector2d, 4> kTagCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};

struct DetectorOptions {
    std::vector<TagFamily> families{TagFamily::Tag36h11};
    /// Factor by which the picture is reduced for the search for quads; bits and edges are read in
    /// the full picture. 1, 1.5 or a whole number up to 8.
    double decimation = 2;
    int threads = 1;     ///< 1 to 64
    double blur = 0;     ///< Gaussian before the search for quads [px of the reduced one], 0..5
    bool refine = true;  ///< snap the quad's edges to the strongest gradient
    /// Detections with more corrected bits are dropped (0 or 1). tag16h5 is often found in noise:
    /// its detections must have no corrected bit and twice the margin.
    int maxHamming = 1;
    /// Width of the black border [cells], 1 or 2. Kalibr prints its tags with 2; all others have 1.
    int borderCells = 1;
    double minMargin = 20;  ///< detections with less contrast are dropped [grey levels]
};

/// Finds AprilTags with libapriltag. One thread at a time.
class TagDetector {
public:
    /// Throws std::invalid_argument for options out of their range, std::runtime_error when the
    /// library is out of memory.
    explicit TagDetector(const DetectorOptions& options);
    ~TagDetector();
    TagDetector(TagDetector&&) noexcept;
    TagDetector& operator=(TagDetector&&) noexcept;

    /// Tags in a Gray8 picture of up to 32767 pixels a side, sorted by tag, then from the left.
    /// With `region`, only tags completely inside it are found. The region is clipped to the
    /// picture and enlarged to the library's grid of tiles, so that a tag is found exactly as in
    /// the whole picture. Throws std::invalid_argument for another format or size.
    [[nodiscard]] std::vector<TagDetection> detect(const ImageView& luma,
                                                   std::optional<PixelRect> region = {});

private:
    struct Library;
    std::unique_ptr<Library> library_;
    DetectorOptions options_;
    std::vector<unsigned char> copy_;  ///< used where the library would blur its input in place
};

/// The black and white picture of a tag as drawn by libapriltag, one pixel per cell, including the
/// quiet zone: `size` x `size` values 0 or 255, row 0 at the top. `corner`: cells from the
/// picture's edge to the tag's corners. Throws std::invalid_argument for an id the family lacks.
struct TagPicture {
    int size = 0;
    int corner = 0;
    std::vector<unsigned char> cells;
};
[[nodiscard]] TagPicture drawTag(TagKey tag);

}  // namespace mfar
