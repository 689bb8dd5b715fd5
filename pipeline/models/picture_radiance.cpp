#include "pipeline/models/picture_radiance.h"

#include "base/image_layout.h"
#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kCellsAcross = 32, kCellsDown = 24, kSamplesASide = 4;

class PixelReader {
public:
    explicit PixelReader(const ImageView& picture)
        : picture_(picture), toRgb_(yuvToRgb(picture.matrix, picture.range)) {}

    [[nodiscard]] Eigen::Vector3f at(int x, int y) const {
        const std::uint8_t* row = picture_.data + static_cast<std::size_t>(y) * picture_.stride;
        switch (picture_.format) {
        case PixelFormat::Gray8: return linear({row[x], row[x], row[x]});
        case PixelFormat::Rgba8: return linear({row[4 * x], row[4 * x + 1], row[4 * x + 2]});
        case PixelFormat::Bgra8: return linear({row[4 * x + 2], row[4 * x + 1], row[4 * x]});
        case PixelFormat::Yuyv: {
            const std::uint8_t* pair = row + 4 * static_cast<std::size_t>(x / 2);
            return fromYuv(row[2 * x], pair[1], pair[3]);
        }
        case PixelFormat::Nv12: {
            const std::uint8_t* uv = chromaRow(0, y) + x / 2 * 2;
            return fromYuv(row[x], uv[0], uv[1]);
        }
        case PixelFormat::Yuv420: {
            const int column = x / 2;
            return fromYuv(row[x], chromaRow(0, y)[column], chromaRow(1, y)[column]);
        }
        }
        return Eigen::Vector3f::Zero();
    }

private:
    [[nodiscard]] const std::uint8_t* chromaRow(int plane, int y) const {
        return picture_.chroma[plane].data +
               static_cast<std::size_t>(y / 2) * picture_.chroma[plane].stride;
    }
    [[nodiscard]] Eigen::Vector3f fromYuv(float y, float u, float v) const {
        std::array<std::uint8_t, 3> rgb{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<float, 4>& row = toRgb_[i];
            const float value = row[0] * y + row[1] * u + row[2] * v + row[3];
            rgb[i] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
        }
        return linear(rgb);
    }
    static Eigen::Vector3f linear(const std::array<std::uint8_t, 3>& rgb) {
        const std::array<float, 256>& table = linearOfSrgbByte();
        return {table[rgb[0]], table[rgb[1]], table[rgb[2]]};
    }

    const ImageView& picture_;
    YuvToRgb toRgb_;
};

int middleOf(int i, int parts, int pixels) {
    return static_cast<int>((2 * std::int64_t{i} + 1) * pixels / (2 * std::int64_t{parts}));
}

Eigen::Vector3f meanOfCell(const PixelReader& pixels, Size size, int column, int row) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int j = 0; j < kSamplesASide; ++j)
        for (int i = 0; i < kSamplesASide; ++i)
            sum += pixels.at(
                middleOf(column * kSamplesASide + i, kCellsAcross * kSamplesASide, size.width),
                middleOf(row * kSamplesASide + j, kCellsDown * kSamplesASide, size.height));
    return sum / (kSamplesASide * kSamplesASide);
}

}  // namespace

void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out) {
    out.clear();
    const PixelReader pixels(picture);
    const double cellWidth = static_cast<double>(camera.size.width) / kCellsAcross,
                 cellHeight = static_cast<double>(camera.size.height) / kCellsDown;
    for (int row = 0; row < kCellsDown; ++row) {
        for (int column = 0; column < kCellsAcross; ++column) {
            const Eigen::Vector2d ray = camera.unproject(
                {(column + 0.5) * cellWidth - 0.5, (row + 0.5) * cellHeight - 0.5});
            const Eigen::Vector3d inCamera(ray.x(), ray.y(), 1);
            // Solid angle of a cell of the picture on the plane z = 1. The third power accounts for
            // the greater distance and the oblique view of cells away from the centre.
            const double angle =
                cellWidth / camera.fx * cellHeight / camera.fy / std::pow(inCamera.norm(), 3);
            out.push_back({(T_world_camera.rotation * inCamera.normalized()).cast<float>(),
                           meanOfCell(pixels, picture.size, column, row),
                           static_cast<float>(angle)});
        }
    }
}

}  // namespace mfar
