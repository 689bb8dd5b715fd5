#include "hal/virtual/image_files.h"

#include "hal/image_layout.h"
#include "hal/virtual/bgr_picture.h"
#include "hal/virtual/png_header.h"
#include "hal/virtual/whole_file.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>
#include <string>
#include <string_view>

namespace mfar {
namespace {

namespace fs = std::filesystem;

bool isPng(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    char first = 0;
    return in.get(first) && first == '\x89';
}

cv::Mat decoded(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) throw ImageFileError(file, "is missing");
    cv::Mat bgr;
    try {
        if (isPng(file)) static_cast<void>(pngSize(file));
        bgr = cv::imread(file.string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const cv::Exception& e) {
        throw ImageFileError(file, "cannot be decoded: " + e.err);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(file, e.what());
    }
    if (bgr.empty()) throw ImageFileError(file, "cannot be decoded as PNG or JPEG");
    return bgr;
}

}  // namespace

StoredImage loadImage(const fs::path& file) {
    const cv::Mat bgr = decoded(file);
    StoredImage out{{bgr.cols, bgr.rows}, PixelFormat::Rgba8, {}};
    out.pixels.resize(bgr.total() * 4);
    cv::Mat rgba(bgr.rows, bgr.cols, CV_8UC4, out.pixels.data());
    cv::cvtColor(bgr, rgba, cv::COLOR_BGR2RGBA);
    return out;
}

void loadImageInto(const fs::path& file, Size expected, std::uint8_t* rgba, std::size_t stride) {
    const cv::Mat bgr = decoded(file);
    if (Size{bgr.cols, bgr.rows} != expected)
        throw ImageFileError(file, fmt::format("is {}x{}, not {}x{}", bgr.cols, bgr.rows,
                                               expected.width, expected.height));
    cv::Mat target(bgr.rows, bgr.cols, CV_8UC4, rgba, stride);
    cv::cvtColor(bgr, target, cv::COLOR_BGR2RGBA);
}

void encodePng(const ImageView& image, std::vector<std::uint8_t>& out) {
    requireSound(image, "picture to be written");
    // Without parameters OpenCV uses one fixed filter and run lengths only, 8 ms for 648x432;
    // asking for compression level 1 takes 22 ms and saves nothing.
    cv::imencode(".png", bgrPicture(image), out);
}

void savePng(const fs::path& file, const ImageView& image) {
    try {
        std::vector<std::uint8_t> bytes;
        encodePng(image, bytes);
        writeWholeFile(file, bytes);
    } catch (const cv::Exception& e) {
        throw ImageFileError(file, "cannot be encoded: " + e.err);
    } catch (const std::runtime_error& e) {
        throw ImageFileError(e.what());
    }
}

}  // namespace mfar
