#include "tests/measure/eval/tag_pictures.h"

#include "hal/virtual/image_files.h"
#include "pipeline/track/luma_window.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;

KnownTag parseTag(const std::string& line, const fs::path& file, int number) {
    KnownTag out;
    auto& c = out.corners;
    int end = 0;
    const int count = std::sscanf(
        line.c_str(), " %d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf) %n", &out.id, &c[0].x(),
        &c[0].y(), &c[1].x(), &c[1].y(), &c[2].x(), &c[2].y(), &c[3].x(), &c[3].y(), &end);
    bool good = count == 9 && static_cast<std::size_t>(end) == line.size();
    for (const Eigen::Vector2d& corner : c)
        good = good && corner.allFinite();
    if (!good)
        throw EvalError(fmt::format("{}:{}: the line is not \"id, (x y), (x y), (x y), (x y)\"",
                                    file.string(), number));
    for (Eigen::Vector2d& corner : c)
        corner.array() -= 0.5;
    return out;
}

std::vector<KnownTag> readTags(const fs::path& file) {
    std::ifstream in(file);
    std::vector<KnownTag> out;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        line.erase(line.find_last_not_of(" \r\t") + 1);
        if (!line.empty()) out.push_back(parseTag(line, file, number));
    }
    return out;
}

Eigen::Vector2d middle(const std::array<Eigen::Vector2d, 4>& c) {
    return (c[0] + c[1] + c[2] + c[3]) / 4;
}

/// Sum of the squared distances between the corners of two quadrilaterals. The file does not tell
/// which corner is the tag's first, nor the direction. So all eight assignments of the corners are
/// tried, and the smallest sum is returned.
double cornerError(const std::array<Eigen::Vector2d, 4>& a,
                   const std::array<Eigen::Vector2d, 4>& b) {
    double least = INFINITY;
    for (const int way : {1, 3})
        for (int first = 0; first < 4; ++first) {
            double sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += (a[k] - b[(first + way * k) % 4]).squaredNorm();
            least = std::min(least, sum);
        }
    return least;
}

TagScore score(const std::vector<KnownTag>& known, std::vector<TagDetection> found, double ms) {
    TagScore out;
    out.ms = ms;
    double sum = 0;
    for (const KnownTag& tag : known) {
        const double reach = 0.5 * (tag.corners[1] - tag.corners[0]).norm();
        const auto match = std::find_if(found.begin(), found.end(), [&](const TagDetection& d) {
            return d.tag.id == tag.id && (middle(d.corners) - middle(tag.corners)).norm() < reach;
        });
        if (match == found.end()) {
            ++out.missed;
            continue;
        }
        sum += cornerError(match->corners, tag.corners);
        ++out.found;
        found.erase(match);
    }
    out.wrong = static_cast<int>(found.size());
    out.cornerPx = out.found > 0 ? std::sqrt(sum / (4 * out.found)) : 0;
    return out;
}

}  // namespace

std::vector<TagPictureFile> tagPicturesOf(const fs::path& folder) {
    std::vector<TagPictureFile> out;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".txt") continue;
        for (const char* ending : {".jpg", ".png"}) {
            const fs::path image = fs::path(entry.path()).replace_extension(ending);
            if (fs::exists(image)) out.push_back({image, readTags(entry.path())});
        }
    }
    if (out.empty())
        throw EvalError(fmt::format(
            "{}: neither a recording nor a folder with pictures NAME.jpg|png and NAME.txt",
            folder.string()));
    std::sort(out.begin(), out.end(),
              [](const auto& a, const auto& b) { return a.image < b.image; });
    return out;
}

std::vector<std::pair<std::string, TagScore>> compareTags(const TagPictureFile& picture,
                                                          const TrackerOptions& options) {
    const StoredImage image = loadImage(picture.image);
    LumaWindow window;
    const ImageView luma = window.of(image.view(), {0, 0, image.size.width, image.size.height});
    DetectorOptions detection;
    detection.families = options.families;
    detection.decimation = options.decimation;
    detection.threads = options.threads;
    TagDetector detector(detection);
    std::vector<TagDetection> tags;
    const double ms = wallMs([&] { tags = detector.detect(luma); });
    std::vector<std::pair<std::string, TagScore>> out;
    out.emplace_back("detector", score(picture.tags, tags, ms));
    const double focal = image.size.width;
    const CameraModel pinhole{
        image.size, focal, focal, 0.5 * image.size.width, 0.5 * image.size.height, {}};
    const CornerRefiner refiner(options.gamma);
    const double more = wallMs([&] {
        for (TagDetection& tag : tags)
            refiner.refine(luma, pinhole, tag);
    });
    out.emplace_back("refined", score(picture.tags, tags, ms + more));
    return out;
}

}  // namespace mfar::eval
