#include "tests/engine/pictures.h"

#include "base/gl/gl.h"
#include "base/gl/pass.h"
#include "hal/device/scale_params.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

std::uint8_t toByte(double v) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0)));
}

double sinc(double x) {
    return std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x;
}

}  // namespace

Waves::Waves(unsigned seed, double shortest, double longest, double contrast, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < count; ++i) {
        const double k =
            2 * std::numbers::pi / (shortest * std::pow(longest / shortest, unit(random)));
        const double angle = 2 * std::numbers::pi * unit(random);
        waves_.push_back({k * std::cos(angle), k * std::sin(angle),
                          2 * std::numbers::pi * unit(random), contrast * std::sqrt(2.0 / count)});
    }
}

TestPicture Waves::shoot(Size size, const Shot& shot) const {
    std::vector<double> sum(static_cast<std::size_t>(size.width) * size.height, 128.0);
    std::vector<double> s(size.width), c(size.width);
    for (const Wave& w : waves_) {
        const double a =
            w.amplitude * sinc(0.5 * shot.footprint * w.kx) * sinc(0.5 * shot.footprint * w.ky);
        for (int x = 0; x < size.width; ++x) {
            const double p = w.kx * ((x + 0.5) * shot.step - 0.5 + shot.shift.x()) + w.phase;
            s[x] = a * std::sin(p);
            c[x] = a * std::cos(p);
        }
        for (int y = 0; y < size.height; ++y) {
            const double p = w.ky * ((y + 0.5) * shot.step - 0.5 + shot.shift.y());
            const double sy = std::sin(p), cy = std::cos(p);
            double* row = &sum[static_cast<std::size_t>(y) * size.width];
            for (int x = 0; x < size.width; ++x)
                row[x] += s[x] * cy + c[x] * sy;
        }
    }
    TestPicture out(size, shot.format, 255);
    const int n = bytesPerPixel(shot.format);
    for (std::size_t i = 0; i < sum.size(); ++i)
        std::fill_n(&out.bytes[i * n], std::min(n, 3), toByte(shot.gain * sum[i] + shot.offset));
    return out;
}

TestPicture randomPicture(Size size, unsigned seed, PixelFormat f) {
    TestPicture out(size, f);
    std::mt19937 random(seed);
    for (auto& b : out.bytes)
        b = static_cast<std::uint8_t>(random() >> 24);
    return out;
}

TestPicture checkerboard(Size size) {
    TestPicture out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            std::fill_n(out.at(x, y), 4, (x + y) % 2 * 255);
    return out;
}

void addNoise(TestPicture& picture, double sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, sigma);
    const std::size_t n = bytesPerPixel(picture.format);
    for (std::size_t i = 0; i < picture.bytes.size(); i += n) {
        const double d = noise(random);
        for (std::size_t k = 0; k < std::min<std::size_t>(n, 3); ++k)
            picture.bytes[i + k] = toByte(picture.bytes[i + k] + d);
    }
}

double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    if (a.size() != b.size()) throw std::invalid_argument("the pictures differ in size");
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(double(a[i]) - b[i], 2);
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.size()) / std::max(sum, 1e-9));
}

StereoRig plainRig(Size video, Size still) {
    CameraModel v;
    v.size = video;
    v.fx = v.fy = video.width;
    v.cx = 0.5 * (video.width - 1);
    v.cy = 0.5 * (video.height - 1);
    return {v, v.scaledTo(still), {}};
}

StereoRig bentRig(Size video, Size still) {
    StereoRig rig = plainRig(video, still);
    rig.video.distortion = {-0.12, 0.03, 0.001, -0.0005, 0.002};
    rig.still.distortion = {0.06, -0.02, -0.0008, 0.0006, -0.001};
    rig.still.cx += 7.3;
    rig.still.cy -= 4.1;
    rig.T_still_video.rotation =
        Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
    return rig;
}

gpu::Texture uploaded(const TestPicture& p, gpu::Filter f) {
    const bool grey = p.format == PixelFormat::Gray8;
    gpu::Texture t(p.size, grey ? gpu::TexelFormat::R8 : gpu::TexelFormat::Rgba8, f);
    t.upload(PlaneView{p.view().data, p.view().stride});
    return t;
}

RgbPlanes planesOf(const TestPicture& p) {
    RgbPlanes out(p.size);
    out.take(p.view());
    return out;
}

std::vector<std::uint8_t> sampled(const gpu::Texture& texture) {
    const Size size = texture.size();
    const gpu::Texture out(size, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer target(out);
    gpu::DrawPass<params::ScalePicture> copy("display_scale.frag");
    copy.run({.left = 0,
              .top = 0,
              .width = size.width,
              .height = size.height,
              .scaleX = 1,
              .scaleY = 1,
              .footprintX = 1,
              .footprintY = 1,
              .pictureWidth = size.width,
              .pictureHeight = size.height,
              .blueFirst = 0},
             {gpu::sampler(0, texture)}, target);
    return out.readRgba8();
}

gpu::Texture floatTexture(Size size, gpu::TexelFormat format, const std::vector<float>& values,
                          gpu::Filter f) {
    gpu::Texture t(size, format, f);
    glBindTexture(GL_TEXTURE_2D, t.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA, GL_FLOAT,
                    values.data());
    return t;
}

}  // namespace mfar
