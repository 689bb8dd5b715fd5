// Shows test pictures on a real screen. This program runs on boards, and in a virtual machine whose
// host takes a screenshot. Usage:
//   mfar-display-probe SCREEN PICTURES PPM SECONDS
// SCREEN is as in openScreen(). The program waits for a screen, shows PICTURES pictures with a
// moving bar, writes the last one to the file PPM as lastShown() returns it, and keeps it on the
// screen for SECONDS. It prints every change of name() with its time [s].

#include "hal/device/display_auto.h"
#include "hal/gl_context.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace mfar {
namespace {

constexpr Size kSize{640, 480};
constexpr int kBarWidth = 16;

// A picture with fine stripes and a bar. Its colours show if channels, rows or columns are
// exchanged.
std::vector<std::uint8_t> testPicture(int bar) {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
            const bool inBar = x >= bar && x < bar + kBarWidth;
            const int red = inBar ? 255 : x * 255 / kSize.width;
            const int green = y * 255 / kSize.height;
            const int blue = x > 320 && y > 240 ? (x % 2) * 255 : (x * 7 + y * 13) % 256;
            for (const int value : {red, green, blue, 255})
                rgba.push_back(static_cast<std::uint8_t>(value));
        }
    return rgba;
}

void savePpm(const std::string& path, const ScreenPicture& picture) {
    std::ofstream file(path, std::ios::binary);
    file << fmt::format("P6\n{} {}\n255\n", picture.size.width, picture.size.height);
    const std::size_t red = picture.format == PixelFormat::Bgra8 ? 2 : 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
        for (const std::size_t channel : {red, std::size_t{1}, 2 - red})
            file.put(static_cast<char>(picture.pixels[i + channel]));
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

class Probe {
public:
    explicit Probe(std::string_view screen)
        : display_(openScreen(screen)), texture_(kSize, gpu::TexelFormat::Rgba8) {
        draw(0);
    }

    void move(int pictures) {
        while (!display_->lastShown())
            show();
        const double begin = seconds();
        for (int i = 1; i <= pictures; ++i) {
            draw(i * 4 % kSize.width);
            show();
        }
        say(fmt::format("{:.2f} pictures a second", pictures / (seconds() - begin)));
    }
    void hold(double duration) {
        for (const double end = seconds() + duration; seconds() < end;)
            show();
    }
    void save(const std::string& path) {
        const std::optional<ScreenPicture> picture = display_->lastShown();
        if (!picture) throw std::runtime_error("no picture has been shown yet");
        savePpm(path, *picture);
        say("saved " + path);
    }

private:
    double seconds() const { return secondsBetween(start_, Timestamp::now()); }
    void draw(int bar) {
        const std::vector<std::uint8_t> pixels = testPicture(bar);
        texture_.upload({pixels.data(), std::size_t{4} * kSize.width});
    }
    void show() {
        display_->show(GlImage{texture_.id(), kSize}, Timestamp::now());
        if (std::string name = display_->name(); name != name_) {
            say(name);
            name_ = std::move(name);
        }
        // Limits the rate if there is no screen or no vertical blank.
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    void say(std::string_view what) const {
        fmt::print("{:.1f} s: {}\n", seconds(), what);
        std::fflush(stdout);
    }

    Timestamp start_ = Timestamp::now();
    std::unique_ptr<ScreenDisplay> display_;
    gpu::Texture texture_;
    std::string name_;
};

double number(std::string_view text) {
    double value = -1;
    std::from_chars(text.data(), text.data() + text.size(), value);
    if (!(value >= 0 && value < 1e6))
        throw std::runtime_error("PICTURES and SECONDS must be numbers");
    return value;
}

void probe(const char* screen, const char* pictures, const std::string& ppm, const char* duration) {
    const std::unique_ptr<GlContext> context = createGlContext();
    fmt::print("{}\n", context->description());
    Probe shown(screen);
    shown.move(static_cast<int>(number(pictures)));
    shown.save(ppm);
    shown.hold(number(duration));
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    try {
        if (argc != 5)
            throw std::runtime_error("usage: mfar-display-probe SCREEN PICTURES PPM SECONDS");
        mfar::probe(argv[1], argv[2], argv[3], argv[4]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mfar-display-probe: %s\n", error.what());
        return 1;
    }
}
