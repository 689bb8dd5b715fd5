#include "hal/virtual/synthetic_build.h"
#include "hal/virtual/synthetic_textures.h"

#include <array>

namespace mfar::synthetic {
namespace {

using V = Eigen::Vector3d;

/// The codes of tags 0 to 35 of family 36h11. The first bit in the family's order is the most
/// significant.
constexpr std::array<std::uint64_t, 36> kTagCodes{
    0xd7e00984bULL, 0xdda664ca7ULL, 0xdc4a1c821ULL, 0xe17b470e9ULL, 0xef91d01b1ULL, 0xf429cdd73ULL,
    0x05da29225ULL, 0x1106cba43ULL, 0x223bed79dULL, 0x21f51213cULL, 0x33eb19ca6ULL, 0x3f76eb0f8ULL,
    0x469a97414ULL, 0x45dcfe0b0ULL, 0x4a6465f72ULL, 0x51801db96ULL, 0x5eb946b4eULL, 0x68a7cc2ecULL,
    0x6f0ba2652ULL, 0x78765559dULL, 0x87b83d129ULL, 0x86cc4a5c5ULL, 0x8b64df90fULL, 0x9c577b611ULL,
    0xa3810f2f5ULL, 0xaf4d75b83ULL, 0xb59a03fefULL, 0xbb1096f85ULL, 0xd1b92fc76ULL, 0xd0dd509d2ULL,
    0xe2cfda160ULL, 0x2ff497c63ULL, 0x47240671bULL, 0x5047a2e55ULL, 0x635ca87c7ULL, 0x691254166ULL};
static_assert(kTagCodes.size() == static_cast<std::size_t>(kGridTags) * kGridTags);

// The texture is a grid of square cells: a white rim, then black squares and tags alternately. The
// side of a cell is a whole number of texels down to mipmap level 4, a sixteenth of the full size,
// so that edges have exact positions.
constexpr int kGapCells = 2, kPitch = kTagCells + kGapCells;
constexpr int kRim = 1;
constexpr int kLayerCells = 2 * kRim + kGridTags * kPitch + kGapCells;
static_assert(kLayerSize % (16 * kLayerCells) == 0);
static_assert(kGapCells == kTagCells * kGridSpacing);

// Side of a cell, side of the whole plate, centre of the plate's front face [m].
constexpr double kCell = kGridTagSize / kTagCells;
constexpr double kPlate = kLayerCells * kCell;
const V kMiddle{0, 0.3, 0.46};
constexpr double kThickness = 0.01;

/// Returns true if a cell inside the rim is white. The cell in column 0 and row 0 belongs to the
/// black square at the top left.
bool isWhite(int column, int row) {
    const int right = column % kPitch - kGapCells, down = row % kPitch - kGapCells;
    if (right < 0 || down < 0) return !(right < 0 && down < 0);
    const int id = (kGridTags - 1 - row / kPitch) * kGridTags + column / kPitch;
    return tagCells(id)[down][right];
}

/// Returns the tag in a column (counted from the left) and a row (counted from the bottom), both
/// from 0.
Tag gridTag(int column, int row) {
    const auto place = [](int i) { return (i - 0.5 * (kGridTags - 1)) * kPitch * kCell; };
    Eigen::Matrix3d turn;  // columns: the tag's x, y and z axes
    turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return {row * kGridTags + column,
            kGridTagSize,
            {Eigen::Quaterniond(turn), kMiddle + V(place(column), 0, place(row))}};
}

}  // namespace

// The 36 bits fill four quarters of the tag, with nine bits each. The positions in a quarter are
// those of the previous quarter, rotated by 90 degrees.
TagCells tagCells(int id) {
    constexpr std::array<std::array<int, 2>, 9> kFirst{
        {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}, {2, 2}, {3, 2}, {4, 2}, {3, 3}}};
    TagCells cells{};
    for (int bit = 0; bit < 36; ++bit) {
        auto [x, y] = kFirst[bit % 9];
        for (int turn = 0; turn < bit / 9; ++turn) {
            const int old = x;
            x = 7 - y;
            y = old;
        }
        cells[y][x] = (kTagCodes.at(id) >> (35 - bit) & 1) != 0;
    }
    return cells;
}

cv::Mat4b aprilGrid(std::uint64_t seed) {
    constexpr int kTexels = kLayerSize / kLayerCells;
    const cv::Mat1f grain = fractal(seed, 200, 200, 2, 0.7F);
    cv::Mat1b white(kLayerCells, kLayerCells, 255);
    for (int y = kRim; y < kLayerCells - kRim; ++y)
        for (int x = kRim; x < kLayerCells - kRim; ++x)
            white(y, x) = isWhite(x - kRim, y - kRim) ? 255 : 0;
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const bool paper = white(at[0] / kTexels, at[1] / kTexels) != 0;
        c = cv::Vec3f::all((paper ? 0.82F : 0.03F) + 0.03F * grain(at));
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.05F));
}

World makeCalibration() {
    Builder b;
    Lighting& light = b.world.light;
    light.towards = V(-0.35, -0.75, 0.55).normalized();
    light.spread = 0.2;
    light.key = {0.85, 0.83, 0.78};
    light.ambient = {0.33, 0.35, 0.38};
    light.background = {0.25, 0.26, 0.28};
    b.world.eye = kMiddle - V(0, 0.62, 0);
    b.world.target = kMiddle;
    const int wood = b.tiled(Layer::Wood, 3.1, V::Ones(), 0.3, 0.5);
    const int plaster = b.tiled(Layer::Plaster, 3.3, {0.80, 0.83, 0.78}, 0.12);
    b.box({0, 0.12, -0.02}, {3.2, 1.6, 0.04}, 0, wood).lightTexels = 144;
    b.box({0, 0.66, 0.9}, {5, 0.04, 3.4}, 0, plaster).lightTexels = 144;
    const int edge = b.tiled(Layer::Enamel, 5, {0.8, 0.8, 0.78});
    const int print = b.material({Layer::AprilGrid, {1 / kPlate, 1 / kPlate}, {0.5, 0.5}});
    b.world.materials[print].variation = 0;
    b.box(kMiddle + V(0, kThickness / 2, 0), {kPlate, kThickness, kPlate}, 0, {edge, print, edge})
        .lightTexels = 32;
    for (int row = 0; row < kGridTags; ++row)
        for (int column = 0; column < kGridTags; ++column)
            b.world.tags.push_back(gridTag(column, row));
    return b.world;
}

}  // namespace mfar::synthetic
