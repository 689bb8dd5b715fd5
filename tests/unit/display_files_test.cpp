#include "base/gl/texture.h"
#include "hal/gl_context.h"
#include "hal/virtual/display_files.h"
#include "hal/virtual/y4m.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace mfar {
namespace {

namespace fs = std::filesystem;
using test::plain;
using test::TempFolder;

std::string refusal(const std::string& spec, double rateHz = 30) {
    try {
        static_cast<void>(openFileDisplay(spec, rateHz));
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "opened";
}

class FileDisplays : public testing::Test {
protected:
    void show(Display& display, const StoredImage& picture, Timestamp time) {
        gpu::Texture texture(picture.size, gpu::TexelFormat::Rgba8);
        texture.upload(PlaneView{picture.view().data, picture.view().stride});
        display.show(GlImage{texture.id(), picture.size}, time);
    }

    std::unique_ptr<GlContext> gl_ = createGlContext();
    TempFolder folder_;
};

TEST_F(FileDisplays, PngContainsTheShownPixelsWithTheTopRowFirst) {
    StoredImage picture = plain({6, 4}, 50);
    picture.pixels[0] = 201;
    picture.pixels[(3 * 6 + 5) * 4 + 2] = 202;
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
        picture.pixels[i] = 255;
    const auto display = openFileDisplay("png:" + (folder_ / "out/frames").string(), 30);
    show(*display, picture, {123});
    display->finish();
    EXPECT_EQ(loadImage(folder_ / "out/frames/123.png").pixels, picture.pixels);
}

TEST_F(FileDisplays, HostRowsAreWrittenLikeATexture) {
    AlignedRows<std::uint32_t> rows({7, 5});
    StoredImage picture = plain({7, 5}, 0);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            const std::size_t i = 4UL * (y * 7 + x);
            rows[y][x] = 0x12000000U + static_cast<std::uint32_t>(x + 16 * y + 256 * (x * y) + 77);
            for (std::size_t k = 0; k < 4; ++k)
                picture.pixels[i + k] = static_cast<std::uint8_t>(rows[y][x] >> (8 * k));
        }
    const auto png = openFileDisplay("png:" + folder_.path().string(), 30);
    const auto y4m = openFileDisplay("y4m:" + (folder_ / "a.y4m").string(), 30);
    for (Display* display : {png.get(), y4m.get()}) {
        show(*display, picture, {1});
        display->show(Rows<const std::uint32_t>(rows.rows()), {2});
        display->finish();
    }
    EXPECT_EQ(loadImage(folder_ / "2.png").pixels, loadImage(folder_ / "1.png").pixels);
    const std::string video = test::readFile(folder_ / "a.y4m");
    const std::size_t frame = 6 + 7 * 5 + 2 * 4 * 3;
    ASSERT_GT(video.size(), 2 * frame);
    EXPECT_EQ(video.substr(video.size() - frame), video.substr(video.size() - 2 * frame, frame));
}

TEST_F(FileDisplays, EveryPictureIsWrittenEvenIfThereAreFewBuffers) {
    const auto display = openFileDisplay("png:" + folder_.path().string(), 30);
    for (int i = 0; i < 25; ++i)
        show(*display, plain({64, 48}, static_cast<std::uint8_t>(i)), {i});
    display->finish();
    for (int i = 0; i < 25; ++i)
        EXPECT_EQ(loadImage(folder_ / fmt::format("{}.png", i)).pixels[0], i);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 25);
}

TEST_F(FileDisplays, ShowingAPictureDoesNotChangeGlBindings) {
    const gpu::Texture target({8, 8}, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer framebuffer(target);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.id());
    const auto display = openFileDisplay("png:" + folder_.path().string(), 30);
    show(*display, plain({8, 8}, 1), {1});
    GLint bound = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), framebuffer.id());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(FileDisplays, AFailedWriteIsReportedByFinishAndByTheNextShow) {
    const auto display = openFileDisplay("png:" + (folder_ / "gone").string(), 30);
    fs::remove_all(folder_ / "gone");
    show(*display, plain({8, 8}, 1), {1});
    EXPECT_THROW(display->finish(), std::runtime_error);
    EXPECT_THROW(show(*display, plain({8, 8}, 1), {2}), std::runtime_error);
}

TEST_F(FileDisplays, Y4mHasTheRightHeaderSizeAndLuma) {
    const fs::path file = folder_ / "a.y4m";
    {
        const auto display = openFileDisplay("y4m:" + file.string(), 29.97);
        show(*display, plain({7, 5}, 255), {1});
        show(*display, plain({7, 5}, 0), {2});
        display->finish();
    }
    const std::string bytes = test::readFile(file);
    const std::string header = "YUV4MPEG2 W7 H5 F30000:1001 Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n";
    ASSERT_EQ(bytes.substr(0, header.size()), header);
    const std::size_t picture = 7 * 5 + 2 * 4 * 3;
    ASSERT_EQ(bytes.size(), header.size() + 2 * (6 + picture));
    const std::string first = bytes.substr(header.size(), 6 + picture);
    const std::string second = bytes.substr(header.size() + 6 + picture);
    EXPECT_EQ(first.substr(0, 6), "FRAME\n");
    EXPECT_EQ(second.substr(0, 6), "FRAME\n");
    EXPECT_EQ(first.substr(6, 35), std::string(35, '\xeb'));
    EXPECT_EQ(second.substr(6, 35), std::string(35, '\x10'));
    EXPECT_EQ(first.substr(41), std::string(24, '\x80'));
}

TEST(Y4m, ChromaIsTheMeanOfFourPixels) {
    // One column of red pixels, then one of blue pixels.
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 4; ++i)
        for (const std::uint8_t value : {i % 2 == 0 ? 240 : 0, 0, i % 2 == 0 ? 0 : 240, 255})
            pixels.push_back(value);
    const auto chromaOf = [](const std::vector<std::uint8_t>& rgba) {
        std::vector<std::uint8_t> out;
        ImageView view;
        view.data = rgba.data();
        view.size = {2, 2};
        view.stride = 8;
        appendY4mFrame(view, out);
        return std::pair(out.at(out.size() - 2), out.back());
    };
    std::vector<std::uint8_t> purple;
    for (int i = 0; i < 4; ++i)
        purple.insert(purple.end(), {120, 0, 120, 255});
    EXPECT_EQ(chromaOf(pixels), chromaOf(purple));
}

TEST_F(FileDisplays, Y4mRefusesAPictureOfAnotherSize) {
    const auto display = openFileDisplay("y4m:" + (folder_ / "a.y4m").string(), 30);
    show(*display, plain({8, 8}, 1), {1});
    EXPECT_THROW(show(*display, plain({8, 10}, 1), {2}), std::runtime_error);
}

TEST_F(FileDisplays, Y4mReachesTheReaderOfAPipe) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = test::readFile(pipe); });
    {
        const auto display = openFileDisplay("y4m:" + pipe.string(), 30);
        for (int i = 0; i < 10; ++i)
            show(*display, plain({320, 240}, 9), {i});
        display->finish();
    }
    reader.join();
    const std::size_t picture = 320 * 240 * 3 / 2 + 6;
    ASSERT_GT(received.size(), 10 * picture);
    EXPECT_EQ(received.substr(received.size() - picture, 6), "FRAME\n");
}

TEST_F(FileDisplays, Y4mWithMinusWritesToStandardOutput) {
    const int before = dup(STDOUT_FILENO);
    const int file = open((folder_ / "out").c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(dup2(file, STDOUT_FILENO), 0);
    const auto display = openFileDisplay("y4m:-", 30);
    ASSERT_GE(dup2(before, STDOUT_FILENO), 0);
    close(file);
    close(before);
    show(*display, plain({8, 8}, 1), {1});
    display->finish();
    EXPECT_EQ(test::readFile(folder_ / "out").substr(0, 16), "YUV4MPEG2 W8 H8 ");
}

TEST_F(FileDisplays, AClosedPipeIsAnErrorAndDoesNotEndTheProcess) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30);
    close(reader);
    show(*display, plain({8, 8}, 1), {1});
    try {
        display->finish();
        FAIL() << "writing without a reader succeeded";
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(e.what(), pipe.string() + ": the reading program has closed the pipe");
    }
}

TEST_F(FileDisplays, CancelEndsTheWaitForAStalledReader) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    std::stop_source stop;
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, stop.get_token());
    show(*display, plain({640, 480}, 1), {1});  // more than a pipe can hold
    stop.request_stop();
    EXPECT_THROW(display->finish(), std::runtime_error);
    close(reader);
}

struct PipeDisplays : FileDisplays {
    PipeDisplays() {
        mkfifo(pipe.c_str(), 0600);
        reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    }
    ~PipeDisplays() override {
        if (reader >= 0) close(reader);
    }
    /// Reads `count` pictures. Returns the luma of the first pixel of the last one.
    int readPictures(std::size_t count) const {
        const std::size_t header = y4mHeader(kSize, 30).size();
        const std::size_t picture = 6 + 640 * 480 * 3 / 2;
        std::string all;
        std::vector<char> part(1 << 16);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (all.size() < header + count * picture && std::chrono::steady_clock::now() < end) {
            const ssize_t n = read(reader, part.data(), part.size());
            if (n > 0)
                all.append(part.data(), static_cast<std::size_t>(n));
            else
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_EQ(all.size(), header + count * picture);
        return static_cast<std::uint8_t>(all[header + (count - 1) * picture + 6]);
    }
    template <class Condition>
    static bool comesTrue(Condition condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!condition() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return condition();
    }

    static constexpr Size kSize{640, 480};
    fs::path pipe = folder_ / "pipe";
    int reader = -1;
};

TEST_F(PipeDisplays, LivePicturesDoNotWaitForAStalledReader) {
    const FileDisplayPolicy live{.isLive = true, .stalled = std::chrono::milliseconds(20)};
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, {}, live);
    show(*display, plain(kSize, 0), {0});
    EXPECT_TRUE(comesTrue([&] { return display->fault().has_value(); }));
    EXPECT_EQ(display->fault(),
              "y4m:" + pipe.string() + ": the reader of the pipe accepts no data");
    for (int i = 1; i <= 50; ++i)
        show(*display, plain(kSize, static_cast<std::uint8_t>(5 * i)), {i});
    // One picture is being written. Each of the other three buffers contains a picture that waits.
    EXPECT_EQ(display->leftOut(), 47U);
    const int last = readPictures(4);
    EXPECT_NEAR(last, 16 + 219 * 250 / 255., 1) << "the newest picture must be written";
    display->finish();
    EXPECT_EQ(display->fault(), std::nullopt);
}

TEST_F(PipeDisplays, WriterWhoseReaderReadsNothingIsOverItsTimeBudget) {
    std::atomic<std::int64_t> passed{0};
    Heartbeats hearts([&] { return Timestamp::now() + std::chrono::seconds(passed); });
    const FileDisplayPolicy live{.isLive = true,
                                 .writer = {&hearts, "writer", std::chrono::seconds(10)}};
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, {}, live);
    show(*display, plain(kSize, 0), {0});
    EXPECT_TRUE(comesTrue([&] {
        passed = passed.load() + 11;
        return hearts.late().size() == 1;
    }));
    (void)readPictures(1);
    EXPECT_TRUE(comesTrue([&] { return hearts.late().empty(); }))
        << "the writer waits for a picture, which is no fault";
}

TEST_F(PipeDisplays, UnreadLivePicturesAreDiscardedAtTheEnd) {
    const FileDisplayPolicy live{.isLive = true, .finish = std::chrono::milliseconds(100)};
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, {}, live);
    show(*display, plain(kSize, 1), {1});
    try {
        display->finish();
        FAIL() << "finish() succeeded although the picture was not read";
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(e.what(), "y4m:" + pipe.string() + ": the reader of the pipe accepts no data");
    }
}

TEST_F(PipeDisplays, WaitingForAReaderIsReported) {
    std::atomic<const char*> said{""};
    const FileDisplayPolicy lossless{.waiting = [&](const char* what) { said = what; }};
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, {}, lossless);
    std::thread reads([&] {
        EXPECT_TRUE(comesTrue([&] {
            return said.load() != nullptr && std::string(said.load()) == "the reader of the pipe";
        }));
        (void)readPictures(6);
    });
    for (int i = 0; i < 6; ++i)
        show(*display, plain(kSize, 1), {i});
    display->finish();
    reads.join();
    EXPECT_EQ(said.load(), nullptr);
    EXPECT_EQ(display->leftOut(), 0U) << "every picture must be written";
}

TEST_F(PipeDisplays, AClosedReaderEndsALiveDisplay) {
    const FileDisplayPolicy live{.isLive = true};
    const auto display = openFileDisplay("y4m:" + pipe.string(), 30, {}, live);
    close(std::exchange(reader, -1));
    EXPECT_TRUE(comesTrue([&] {
        try {
            show(*display, plain(kSize, 1), {1});
            return false;
        } catch (const std::runtime_error& e) {
            return e.what() == pipe.string() + ": the reading program has closed the pipe";
        }
    }));
}

TEST_F(FileDisplays, FullDiskEndsALiveDisplay) {
    const FileDisplayPolicy live{.isLive = true};
    const auto display = openFileDisplay("y4m:/dev/full", 30, {}, live);
    show(*display, plain({64, 48}, 1), {1});
    EXPECT_THROW(display->finish(), std::runtime_error);
    EXPECT_THROW(show(*display, plain({64, 48}, 1), {2}), std::runtime_error);
}

TEST_F(FileDisplays, DisplayNoneAcceptsPicturesAndWritesNothing) {
    const auto display = openFileDisplay("none", 30);
    show(*display, plain({8, 8}, 1), {1});
    display->finish();
    EXPECT_EQ(display->name(), "none");
}

TEST(OpenFileDisplay, ErrorsAreReported) {
    const TempFolder folder;
    test::writeFile(folder / "file", "x");
    EXPECT_EQ(refusal("jpg:/tmp"),
              "unknown display 'jpg:/tmp'; expected png:FOLDER, y4m:FILE, y4m:- or none");
    EXPECT_EQ(refusal(""), "unknown display ''; expected png:FOLDER, y4m:FILE, y4m:- or none");
    EXPECT_EQ(refusal("png:"), "png: no folder is given; expected png:FOLDER");
    EXPECT_EQ(refusal("y4m:"), "y4m: needs a file name, or - for standard output");
    const std::string under = (folder / "file/under").string();
    EXPECT_EQ(refusal("png:" + under), under + ": the folder cannot be created: Not a directory");
    EXPECT_EQ(refusal("y4m:" + under), under + ": Not a directory");
    EXPECT_EQ(refusal("y4m:" + (folder / "a").string(), 0),
              "y4m: the frame rate must be from 0.001 to 1000000 Hz, not 0 Hz");
}

TEST(Y4mHeader, CommonRatesAreWrittenAsFractions) {
    const auto rate = [](double hz) {
        const std::string header = y4mHeader({2, 2}, hz);
        const std::size_t at = header.find('F');
        return header.substr(at, header.find(' ', at) - at);
    };
    EXPECT_EQ(rate(30), "F30:1");
    EXPECT_EQ(rate(12.5), "F12500:1000");
    EXPECT_EQ(rate(59.94), "F60000:1001");
    EXPECT_EQ(rate(24000.0 / 1001), "F24000:1001");
    EXPECT_EQ(rate(0.5), "F500:1000");
}

}  // namespace
}  // namespace mfar
