#include "pipeline/track/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <tuple>

namespace mfar {
namespace {

constexpr int kLargestSide = 32767;  // libapriltag stores half pixels in 16 bits
constexpr int kSmallestSide = 16;    // [decimated px]; tags in smaller pictures cannot be read
constexpr int kTile = 4;             // side of libapriltag's threshold tiles [decimated px]

struct FamilyMaker {
    apriltag_family_t* (*create)();
    void (*destroy)(apriltag_family_t*);
};

FamilyMaker makerOf(TagFamily family) {
    switch (family) {
    case TagFamily::Tag25h9: return {tag25h9_create, tag25h9_destroy};
    case TagFamily::Tag16h5: return {tag16h5_create, tag16h5_destroy};
    case TagFamily::TagStandard41h12: return {tagStandard41h12_create, tagStandard41h12_destroy};
    case TagFamily::Tag36h11: break;
    }
    return {tag36h11_create, tag36h11_destroy};
}

using FamilyHandle = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

FamilyHandle makeFamily(TagFamily family) {
    const FamilyMaker maker = makerOf(family);
    return {maker.create(), maker.destroy};
}

/// Makes the black border of the tags one cell wider. The codes stay the same.
void widenBorder(apriltag_family_t& family) {
    family.width_at_border += 2;
    family.total_width += 2;
    for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
        ++family.bit_x[bit];
        ++family.bit_y[bit];
    }
}

struct DetectorDeleter {
    void operator()(apriltag_detector_t* d) const { apriltag_detector_destroy(d); }
};
struct DetectionsDeleter {
    void operator()(zarray_t* d) const { apriltag_detections_destroy(d); }
};

// Does the same as image_u8_destroy(). That function cannot be used here, because on Debian it is
// in another library.
struct ImageDeleter {
    void operator()(image_u8_t* image) const {
        std::free(image->buf);
        std::free(image);
    }
};

void require(bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("tag detector: ") + what);
}

void check(const DetectorOptions& o) {
    require(!o.families.empty(), "no tag family is given");
    const double d = o.decimation;
    require(d == 1.5 || (d >= 1 && d <= 8 && d == std::floor(d)),
            "decimation must be 1.5 or a whole number from 1 to 8");
    require(o.threads >= 1 && o.threads <= 64, "threads must be from 1 to 64");
    require(o.blur >= 0 && o.blur <= 5, "blur must be from 0 to 5");
    require(o.maxHamming == 0 || o.maxHamming == 1, "maxHamming must be 0 or 1");
    require(o.borderCells == 1 || o.borderCells == 2, "borderCells must be 1 or 2");
    require(o.minMargin >= 0 && o.minMargin <= 255, "minMargin must be from 0 to 255");
}

/// Returns the rectangle in which tags in `region` are searched. It is enlarged to whole threshold
/// tiles of the picture.
PixelRect searched(Size size, const std::optional<PixelRect>& region, double decimation) {
    if (!region) return {0, 0, size.width, size.height};
    const int grid = static_cast<int>(kTile * decimation);
    const auto down = [&](int v, int most) { return std::clamp(v, 0, most) / grid * grid; };
    const auto up = [&](int v, int most) {
        return std::min((std::clamp(v, 0, most) + grid - 1) / grid * grid, most);
    };
    return {down(region->x0, size.width), down(region->y0, size.height), up(region->x1, size.width),
            up(region->y1, size.height)};
}

bool trusted(const TagDetection& d, const DetectorOptions& o) {
    const bool weak = d.tag.family == TagFamily::Tag16h5;
    return d.hamming <= (weak ? 0 : o.maxHamming) && d.margin >= (weak ? 2 : 1) * o.minMargin;
}

}  // namespace

struct TagDetector::Library {
    std::vector<FamilyHandle> families;  // must outlive `detector`, which refers to them
    std::unique_ptr<apriltag_detector_t, DetectorDeleter> detector;

    [[nodiscard]] TagDetection translate(const apriltag_detection_t& found, PixelRect from) const {
        TagDetection out;
        out.tag = {tagFamilyNamed(found.family->name).value(), found.id};
        out.hamming = found.hamming;
        out.margin = found.decision_margin;
        // libapriltag places the centre of the first pixel at (0.5, 0.5), mfar at (0, 0).
        for (int k = 0; k < 4; ++k)
            out.corners[k] = {found.p[k][0] - 0.5 + from.x0, found.p[k][1] - 0.5 + from.y0};
        return out;
    }
};

TagDetector::TagDetector(const DetectorOptions& options)
    : library_(std::make_unique<Library>()), options_(options) {
    check(options);
    library_->detector.reset(apriltag_detector_create());
    if (!library_->detector) throw std::runtime_error("libapriltag cannot allocate memory");
    apriltag_detector_t& detector = *library_->detector;
    detector.nthreads = options.threads;
    detector.quad_decimate = static_cast<float>(options.decimation);
    detector.quad_sigma = static_cast<float>(options.blur);
    detector.refine_edges = options.refine;
    std::vector<TagFamily> families = options.families;
    std::sort(families.begin(), families.end());
    families.erase(std::unique(families.begin(), families.end()), families.end());
    for (const TagFamily family : families) {
        library_->families.push_back(makeFamily(family));
        if (options.borderCells == 2) widenBorder(*library_->families.back());
        // One wrong bit is corrected. To correct two bits, libapriltag would need tables of 90 MB
        // for tagStandard41h12, and would find twice as many false tags.
        apriltag_detector_add_family_bits(&detector, library_->families.back().get(), 1);
    }
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

std::vector<TagDetection> TagDetector::detect(const ImageView& luma,
                                              std::optional<PixelRect> region) {
    require(luma.format == PixelFormat::Gray8, "the picture must have the format Gray8");
    require(luma.size.width <= kLargestSide && luma.size.height <= kLargestSide,
            "the picture must not be larger than 32767x32767 pixels");
    const PixelRect part = searched(luma.size, region, options_.decimation);
    const int width = part.x1 - part.x0, height = part.y1 - part.y0;
    const double least = kSmallestSide * options_.decimation;
    if (!(width >= least && height >= least)) return {};
    const std::uint8_t* first = luma.data + part.y0 * luma.stride + part.x0;
    // If libapriltag blurs a picture that is not decimated, it writes to its input. In this case,
    // its input is a copy.
    auto* pixels = const_cast<std::uint8_t*>(first);
    auto stride = static_cast<int>(luma.stride);
    if (options_.blur > 0 && options_.decimation == 1) {
        copy_.resize(static_cast<std::size_t>(width) * height);
        for (int y = 0; y < height; ++y)
            std::memcpy(copy_.data() + static_cast<std::size_t>(y) * width, first + y * luma.stride,
                        width);
        pixels = copy_.data();
        stride = width;
    }
    image_u8_t view{width, height, stride, pixels};
    const std::unique_ptr<zarray_t, DetectionsDeleter> found(
        apriltag_detector_detect(library_->detector.get(), &view));
    std::vector<TagDetection> out;
    for (int i = 0; found && i < zarray_size(found.get()); ++i) {
        apriltag_detection_t* one = nullptr;
        zarray_get(found.get(), i, static_cast<void*>(&one));
        const TagDetection detection = library_->translate(*one, part);
        if (trusted(detection, options_)) out.push_back(detection);
    }
    // The order in which libapriltag returns tags depends on the number of threads, so they are
    // sorted.
    std::sort(out.begin(), out.end(), [](const TagDetection& a, const TagDetection& b) {
        return std::tuple(a.tag, a.corners[0].x(), a.corners[0].y()) <
               std::tuple(b.tag, b.corners[0].x(), b.corners[0].y());
    });
    return out;
}

TagPicture drawTag(TagKey tag) {
    require(tag.id >= 0 && tag.id < info(tag.family).count,
            "the id does not exist in this tag family");
    const FamilyHandle family = makeFamily(tag.family);
    const std::unique_ptr<image_u8_t, ImageDeleter> image(apriltag_to_image(family.get(), tag.id));
    TagPicture out;
    out.size = image->width;
    out.corner = (family->total_width - family->width_at_border) / 2;
    for (int y = 0; y < image->height; ++y)
        out.cells.insert(out.cells.end(), image->buf + y * image->stride,
                         image->buf + y * image->stride + image->width);
    return out;
}

}  // namespace mfar
