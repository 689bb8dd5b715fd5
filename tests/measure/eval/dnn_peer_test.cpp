#include "tests/measure/eval/dnn_peer.h"
#include "tests/measure/eval/report.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mfar::eval {
namespace {

using test::TempFolder;

/// TensorFlow's network files are protocol buffers. These functions encode their fields.
std::string varint(unsigned long value) {
    std::string out;
    for (; value >= 128; value >>= 7)
        out += static_cast<char>(value % 128 + 128);
    return out + static_cast<char>(value);
}
std::string field(unsigned number, unsigned long value) {
    return varint(8UL * number) + varint(value);
}
std::string field(unsigned number, const std::string& bytes) {
    return varint(8UL * number + 2) + varint(bytes.size()) + bytes;
}
std::string attribute(const std::string& name, const std::string& value) {
    return field(5, field(1, name) + field(2, value));
}
std::string node(const std::string& name, const std::string& op,
                 const std::vector<std::string>& inputs, const std::string& attributes) {
    std::string out = field(1, name) + field(2, op);
    for (const std::string& input : inputs)
        out += field(3, input);
    return field(1, out + attributes);
}

std::string copiesToPixels(int copies) {
    constexpr unsigned long kFloat = 1;
    const std::string type = field(6, kFloat);
    std::string shape, values;
    for (const int size : {1, 1, 1, copies})
        shape += field(2, field(1, static_cast<unsigned long>(size)));
    const float one = 1;
    for (int i = 0; i < copies; ++i) {
        std::string bytes(sizeof one, '\0');
        std::memcpy(bytes.data(), &one, sizeof one);
        values += bytes;
    }
    const std::string tensor = field(1, kFloat) + field(2, shape) + field(4, values);
    const std::string steps = field(1, field(3, varint(1) + varint(1) + varint(1) + varint(1)));
    return node("in", "Placeholder", {}, attribute("dtype", type)) +
           node("taps", "Const", {},
                attribute("dtype", type) + attribute("value", field(8, tensor))) +
           node("copies", "Conv2D", {"in", "taps"},
                attribute("T", type) + attribute("strides", steps) +
                    attribute("padding", field(2, std::string("SAME"))) +
                    attribute("data_format", field(2, std::string("NHWC")))) +
           node("out", "DepthToSpace", {"copies"},
                attribute("T", type) + attribute("block_size", field(3, 2UL)));
}

std::filesystem::path write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

std::string refusal(const std::filesystem::path& file) {
    try {
        (void)dnnEnlarger(file, {72, 54});
    } catch (const EvalError& e) {
        return e.what();
    }
    return "";
}

bool builtWithout() {
    return refusal("EDSR_x2.pb").find("built without") != std::string::npos;
}

TEST(DnnPeer, TheFileNameGivesTheModelAndItsFactor) {
    EXPECT_EQ(dnnModelNamed("/a/EDSR_x4.pb").algorithm, "edsr");
    EXPECT_EQ(dnnModelNamed("/a/EDSR_x4.pb").scale, 4);
    EXPECT_EQ(dnnModelNamed("FSRCNN-small_x3.pb").algorithm, "fsrcnn");
    EXPECT_EQ(dnnModelNamed("LapSRN_x8.pb").scale, 8);
    for (const char* name : {"x4.pb", "EDSR.pb", "ESPCN_x5.pb", "SRGAN_x4.pb"})
        EXPECT_THROW((void)dnnModelNamed(name), EvalError) << name;
}

/// Enlarges a video by a network that repeats each pixel. Rows, columns and colours must keep their
/// order. `colour`: difference between the levels of two channels. `most`: largest error of the
/// network's enlargement, and of its further enlargement by a cubic.
void expectRepeated(int colour, std::array<double, 2> most) {
    const TempFolder folder;
    const auto file = write(folder / "ESPCN_x2.pb", copiesToPixels(4));
    cv::Mat video(15, 20, CV_8UC3);
    for (int y = 0; y < video.rows; ++y)
        for (int x = 0; x < video.cols; ++x)
            for (int c = 0; c < 3; ++c)
                video.at<cv::Vec3b>(y, x)[c] = static_cast<uchar>(5 * x + 7 * y + colour * c);
    cv::Mat repeated, wider;
    cv::resize(video, repeated, {40, 30}, 0, 0, cv::INTER_NEAREST);
    EXPECT_LE(cv::norm(dnnEnlarger(file, {40, 30})(video), repeated, cv::NORM_INF), most[0]);
    cv::resize(repeated, wider, {72, 54}, 0, 0, cv::INTER_CUBIC);
    EXPECT_LE(cv::norm(dnnEnlarger(file, {72, 54})(video), wider, cv::NORM_INF), most[1]);
}

TEST(DnnPeer, AModelEnlargesTheVideo) {
    if (builtWithout()) GTEST_SKIP() << "built without OpenCV's dnn_superres";
    expectRepeated(0, {1, 2});
}

// OpenCV converts the colours to 8-bit YCrCb and back, which rounds them once more.
TEST(DnnPeer, ColoursKeepTheirOrder) {
    if (builtWithout()) GTEST_SKIP() << "built without OpenCV's dnn_superres";
    expectRepeated(25, {2, 3});
}

TEST(DnnPeer, FilesThatAreNotModelsAreRefused) {
    if (builtWithout()) GTEST_SKIP() << "built without OpenCV's dnn_superres";
    const TempFolder folder;
    const std::string good = copiesToPixels(4);
    const std::pair<std::filesystem::path, std::string> cases[] = {
        {folder / "absent_x2.pb", "a model's file name must be"},
        {folder / "ESPCN_x2.pb", "no such file"},
        {write(folder / "EDSR_x2.pb", "these are words"), "cannot use this file"},
        {write(folder / "EDSR_x3.pb", ""), "cannot use this file"},
        {write(folder / "FSRCNN_x2.pb", good.substr(0, good.size() / 2)), "cannot use this file"},
        {write(folder / "ESPCN_x3.pb", good), "cannot use this file"},
    };
    for (const auto& [file, message] : cases) {
        const std::string said = refusal(file);
        EXPECT_NE(said.find(message), std::string::npos) << file << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace mfar::eval
