#include "tests/demo/demo_video.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar::demo {
namespace {

struct Header {
    int width = 0;
    int height = 0;
    double rateHz = 0;
};

[[noreturn]] void refuse(const std::filesystem::path& file, const char* why) {
    throw std::runtime_error(file.string() + ": " + why);
}

Header readHeader(std::istream& in, const std::filesystem::path& file) {
    std::string line;
    std::getline(in, line);
    Header header;
    int numerator = 0, denominator = 0;
    const int read = std::sscanf(line.c_str(), "YUV4MPEG2 W%d H%d F%d:%d", &header.width,
                                 &header.height, &numerator, &denominator);
    const bool halved = line.find(" C420") != std::string::npos;
    if (read != 4 || !halved || denominator <= 0) refuse(file, "is not a 4:2:0 Y4M file");
    if (header.width <= 0 || header.height <= 0 || header.width % 4 != 0 || header.height % 4 != 0)
        refuse(file, "width and height must be multiples of 4");
    header.rateHz = static_cast<double>(numerator) / denominator;
    return header;
}

}  // namespace

void writeVideo(const std::filesystem::path& y4m, const std::filesystem::path& avi) {
    std::ifstream in(y4m, std::ios::binary);
    if (!in) refuse(y4m, "cannot be read");
    const Header header = readHeader(in, y4m);
    const cv::Size half(header.width / 2, header.height / 2);
    cv::VideoWriter out(avi.string(), cv::CAP_OPENCV_MJPEG,
                        cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), header.rateHz, half);
    if (!out.isOpened()) refuse(avi, "cannot be written");
    out.set(cv::VIDEOWRITER_PROP_QUALITY, 92);
    cv::Mat planes(header.height * 3 / 2, header.width, CV_8U), picture, small;
    const auto bytes = static_cast<std::streamsize>(planes.total());
    int frames = 0;
    for (std::string line; std::getline(in, line) && line.starts_with("FRAME"); ++frames) {
        in.read(reinterpret_cast<char*>(planes.data), bytes);
        if (in.gcount() != bytes) refuse(y4m, "ends in the middle of a frame");
        cv::cvtColor(planes, picture, cv::COLOR_YUV2BGR_I420);
        cv::resize(picture, small, half, 0, 0, cv::INTER_AREA);
        out.write(small);
    }
    if (frames == 0) refuse(y4m, "has no frames");
}

}  // namespace mfar::demo
