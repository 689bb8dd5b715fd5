#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

// Makes films of a recording for the cameras of the test bed. Each sensor gets two files: its
// pictures in NV12 (BT.601, limited range), one after the other; and their times [s], one per line,
// since the first video frame.

namespace mfar {
namespace {

/// Writes a picture in NV12: interleaves the planes U and V, which OpenCV gives separately.
void writeNv12(std::ofstream& out, const StoredImage& image) {
    cv::Mat rgba(image.size.height, image.size.width, CV_8UC4,
                 const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat planes;
    cv::cvtColor(rgba, planes, cv::COLOR_RGBA2YUV_I420);
    const auto luma = static_cast<std::size_t>(image.size.width) * image.size.height;
    const std::uint8_t* u = planes.data + luma;
    const std::uint8_t* v = u + luma / 4;
    std::vector<char> chroma;
    chroma.reserve(luma / 2);
    for (std::size_t i = 0; i < luma / 4; ++i) {
        chroma.push_back(static_cast<char>(u[i]));
        chroma.push_back(static_cast<char>(v[i]));
    }
    out.write(reinterpret_cast<const char*>(planes.data), static_cast<std::streamsize>(luma));
    out.write(chroma.data(), static_cast<std::streamsize>(chroma.size()));
}

void writeFilm(const std::filesystem::path& file, const std::vector<RecordedImage>& images,
               Timestamp begin) {
    std::ofstream pictures(file.string() + ".nv12", std::ios::binary);
    std::ofstream times(file.string() + ".times");
    for (const RecordedImage& image : images) {
        const StoredImage picture = loadImage(image.file);
        if (picture.size.width % 2 != 0 || picture.size.height % 2 != 0)
            throw std::runtime_error(image.file.string() + ": width and height must be even");
        writeNv12(pictures, picture);
        times << fmt::format("{:.9f}\n", secondsBetween(begin, image.time));
    }
    pictures.close();
    times.close();
    if (!pictures || !times) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: mfar-film RECORDING FOLDER\n");
        return 64;
    }
    try {
        const mfar::Recording recording = mfar::loadRecording(argv[1]);
        const std::filesystem::path folder = argv[2];
        std::filesystem::create_directories(folder);
        mfar::writeFilm(folder / "video", recording.video, recording.video.front().time);
        mfar::writeFilm(folder / "still", recording.stills, recording.video.front().time);
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-film: {}\n", error.what());
        return 1;
    }
}
