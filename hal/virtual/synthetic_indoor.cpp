#include "hal/virtual/synthetic_build.h"
#include "hal/virtual/synthetic_hash.h"

#include <array>

namespace mfar::synthetic {
namespace {

using V = Eigen::Vector3d;

const V kWhite{1, 1, 1};

Lighting windowLight() {
    Lighting light;
    light.towards = V(-0.75, -0.30, 0.68).normalized();
    light.spread = 0.11;
    light.key = {1.08, 0.99, 0.85};
    light.ambient = {0.27, 0.30, 0.36};
    light.background = {0.25, 0.26, 0.28};
    return light;
}

void addBottle(Builder& b, const V& foot) {
    const int glass = b.tiled(Layer::Enamel, 6, {0.05, 0.17, 0.08}, 0.2, 1.0);
    const int cap = b.tiled(Layer::Enamel, 30, {0.62, 0.49, 0.16}, 0.1, 0.8);
    const V up{0, 0, 1};
    constexpr double kRadius = 0.036;
    const int label = b.material(
        {Layer::Label, {1 / (1.9 * kRadius), 1 / 0.085}, {0.5, 0.5}, {1, 0.97, 0.88}, 0.1, 0.15});
    b.cylinder(foot + 0.085 * up, kRadius, 0.17, glass, glass).lightTexels = 24;
    b.cylinder(foot + 0.085 * up, kRadius + 0.0004, 0.085, label, glass).lightTexels = 24;
    b.ellipsoid(foot + 0.17 * up, {kRadius, kRadius, 0.036}, 0, glass);
    b.cylinder(foot + 0.222 * up, 0.0125, 0.05, glass, glass);
    b.cylinder(foot + 0.243 * up, 0.0145, 0.018, cap, cap);
}

void addMug(Builder& b, const V& foot, const V& tint) {
    const int glaze = b.tiled(Layer::Enamel, 8, tint, 0.15, 0.9);
    const int coffee = b.tiled(Layer::Enamel, 10, {0.09, 0.045, 0.02}, 0.3, 0.6);
    b.cylinder(foot + V(0, 0, 0.0475), 0.041, 0.095, glaze, coffee).lightTexels = 24;
    b.rod(foot + V(0.038, -0.012, 0.075), foot + V(0.068, -0.022, 0.06), 0.006, glaze);
    b.rod(foot + V(0.066, -0.022, 0.064), foot + V(0.064, -0.021, 0.03), 0.006, glaze);
    b.rod(foot + V(0.066, -0.021, 0.033), foot + V(0.038, -0.012, 0.02), 0.006, glaze);
}

void addSheets(Builder& b, Random& random) {
    const int paper = b.sheet(Layer::Paper, 0.21, 0.297, kWhite);
    const int article = b.sheet(Layer::Article, 0.21, 0.297, kWhite);
    const V a4{0.21, 0.297, 0.0006};
    const auto sway = [&] { return random.range(-0.05, 0.05); };
    b.box({-0.02, -0.13, 0.0013}, a4, -0.06 + sway(), article).lightTexels = 32;
    b.box({-0.25, -0.06, 0.0003}, a4, 0.22 + sway(), paper).lightTexels = 32;
    b.box({-0.225, -0.045, 0.0009}, a4, 0.09 + sway(), article).lightTexels = 32;
    b.box({0.285, -0.20, 0.0003}, a4, -0.25 + sway(), paper).lightTexels = 32;
}

void addRoom(Builder& b) {
    const int wood = b.tiled(Layer::Wood, 3.1, kWhite, 0.3, 0.5);
    const int plaster = b.tiled(Layer::Plaster, 3.3, {0.80, 0.83, 0.78}, 0.12);
    b.box({0, 0.12, -0.02}, {2.2, 1.3, 0.04}, 0, wood).lightTexels = 250;
    b.box({0, 0.66, 0.6}, {5, 0.04, 3.4}, 0, plaster).lightTexels = 144;
}

void addDesk(Builder& b, Random& random) {
    addRoom(b);
    addSheets(b, random);
    b.lyingBook({0.25, 0.12, 0}, {0.155, 0.22, 0.030}, 0.35, {0.75, 0.16, 0.12});
    b.lyingBook({0.255, 0.125, 0.030}, {0.145, 0.205, 0.022}, 0.12, {0.16, 0.36, 0.62});
    b.lyingBook({0.25, 0.12, 0.052}, {0.125, 0.18, 0.026}, -0.20, {0.85, 0.62, 0.18});
    b.standingBook({-0.36, 0.40, 0}, {0.034, 0.16, 0.235}, 0.0, {0.16, 0.42, 0.28});
    b.standingBook({-0.318, 0.39, 0}, {0.040, 0.17, 0.215}, 0.0, {0.70, 0.66, 0.58});
    b.standingBook({-0.280, 0.40, 0}, {0.027, 0.16, 0.245}, 0.02, {0.45, 0.12, 0.35});
    b.standingBook({-0.234, 0.40, 0}, {0.045, 0.15, 0.200}, -0.06, {0.18, 0.25, 0.48});
    addBottle(b, {0.085, 0.19, 0});
    addMug(b, {-0.155, 0.20, 0}, {0.78, 0.40, 0.22});
    const int cork = b.tiled(Layer::Weave, 5, {0.95, 0.80, 0.62}, 0.2);
    b.box({-0.155, 0.20, 0.001}, {0.13, 0.13, 0.002}, 0.15, cork).lightTexels = 32;
    const int pen = b.tiled(Layer::Enamel, 25, {0.05, 0.09, 0.35}, 0.1, 0.9);
    const int tip = b.tiled(Layer::Enamel, 25, {0.75, 0.72, 0.66}, 0.1, 0.9);
    b.rod({0.105, -0.245, 0.0062}, {0.175, -0.125, 0.0062}, 0.0045, pen);
    b.rod({0.097, -0.2587, 0.0062}, {0.106, -0.2433, 0.0062}, 0.0025, tip);
    const int peel = b.tiled(Layer::Plaster, 7, {1.0, 0.42, 0.05}, 0.1, 0.4);
    b.ellipsoid({0.015, 0.085, 0.034}, {0.036, 0.036, 0.034}, 0.5, peel).lightTexels = 24;
    const int poster = b.sheet(Layer::Article, 0.30, 0.42, {0.93, 0.95, 1.0});
    b.box({0.27, 0.6385, 0.34}, {0.30, 0.003, 0.42}, 0, poster).lightTexels = 32;
    const int cloth = b.tiled(Layer::Weave, 4.2, {0.80, 0.34, 0.28}, 0.2);
    b.box({-0.33, -0.27, 0.001}, {0.26, 0.16, 0.002}, -0.2, cloth).lightTexels = 32;
}

void addBookRows(Builder& b, Random& random) {
    for (const double floor : {0.119, 0.439}) {
        for (const double from : {-0.58, 0.03}) {
            double x = from;
            for (int i = 0; i < 5; ++i) {
                const V size{random.range(0.02, 0.05), random.range(0.13, 0.2),
                             random.range(0.17, 0.26)};
                const V tint{random.range(0.15, 0.9), random.range(0.15, 0.8),
                             random.range(0.12, 0.7)};
                x += size.x() / 2;
                b.standingBook({x, 0.14 + size.y() / 2 + random.range(0, 0.06), floor}, size, 0,
                               tint);
                x += size.x() / 2 + 0.002;
            }
        }
    }
}

void addStalksAndWires(Builder& b) {
    const int stalk = b.tiled(Layer::Bark, 6, {0.9, 1.1, 0.7}, 0.2);
    const int wire = b.tiled(Layer::Enamel, 20, {0.5, 0.5, 0.53}, 0.1, 0.8);
    b.rod({-0.16, -0.16, -0.2}, {-0.13, -0.1, 0.95}, 0.0035, stalk);
    b.rod({0.20, -0.2, -0.2}, {0.14, -0.12, 0.95}, 0.005, stalk);
    b.rod({0.27, -0.05, -0.2}, {0.28, -0.05, 1.0}, 0.0015, wire);
    b.rod({-0.42, -0.02, -0.2}, {-0.43, -0.02, 1.0}, 0.0012, wire);
    b.rod({-0.5, -0.25, 0.33}, {0.5, -0.22, 0.37}, 0.002, wire);
}

}  // namespace

World makeOffice(std::uint64_t seed, bool withMover) {
    Builder b;
    Random random(seed);
    b.world.light = windowLight();
    b.world.eye = {0.01, -0.60, 0.40};
    b.world.target = {0.01, 0.10, 0.045};
    addDesk(b, random);
    b.standingTag(0, {-0.025, 0.33, 0.0625}, 0.10, 0.12);
    b.lyingTag(1, {0.16, -0.055, 0.003}, 0.06, -0.3);
    b.standingTag(2, {-0.11, 0.636, 0.185}, 0.11, 0);
    if (!withMover) return b.world;
    const int crate = b.tiled(Layer::Wood, 9, {1.1, 0.9, 0.7}, 0.3, 0.2);
    const int print = b.sheet(Layer::Article, 0.075, 0.055, {0.9, 1.0, 0.85});
    const int wheel = b.tiled(Layer::Weave, 12, {0.25, 0.25, 0.27}, 0.1);
    const V at{-0.01, -0.06, 0};
    b.world.moverPivot = at + V(0, 0, 0.035);
    b.world.moverRadius = 0.05;
    b.box(at + V(0, 0, 0.044), {0.075, 0.055, 0.055}, 0, {crate, print, print}).moves = true;
    for (const auto& [x, y] : std::array<std::array<double, 2>, 4>{
             {{-0.025, -0.028}, {0.025, -0.028}, {-0.025, 0.028}, {0.025, 0.028}}})
        b.rod(at + V(x, y - 0.004, 0.0165), at + V(x, y + 0.004, 0.0165), 0.0145, wheel).moves =
            true;
    return b.world;
}

World makeShelf(std::uint64_t seed) {
    Builder b;
    Random random(seed);
    b.world.light = windowLight();
    b.world.light.towards = V(-0.45, -0.75, 0.6).normalized();
    b.world.eye = {0.0, -0.95, 0.52};
    b.world.target = {0.0, 0.2, 0.45};
    const int board = b.tiled(Layer::Wood, 2.6, {0.95, 0.95, 1.0}, 0.3, 0.3);
    const int back = b.tiled(Layer::Plaster, 2.8, {0.72, 0.78, 0.84}, 0.15);
    b.box({0, 0.56, 0.5}, {4, 0.02, 3}, 0, back).lightTexels = 144;
    for (const double z : {0.11, 0.43, 0.75})
        b.box({0, 0.26, z}, {1.3, 0.30, 0.018}, 0, board).lightTexels = 80;
    for (const double x : {-0.62, 0.0, 0.62})
        b.box({x, 0.27, 0.5}, {0.018, 0.29, 0.84}, 0, board).lightTexels = 48;
    addBookRows(b, random);
    addBottle(b, {0.33, 0.17, 0.439});
    addMug(b, {-0.27, 0.19, 0.119}, {0.25, 0.45, 0.70});
    b.lyingBook({-0.24, 0.21, 0.439}, {0.15, 0.2, 0.03}, 0.2, {0.8, 0.5, 0.15});
    const int peel = b.tiled(Layer::Plaster, 7, {0.85, 0.25, 0.08}, 0.1, 0.4);
    b.ellipsoid({-0.24, 0.2, 0.505}, {0.036, 0.036, 0.036}, 0, peel).lightTexels = 24;
    addStalksAndWires(b);
    b.standingTag(0, {0.09, 0.085, 0.52}, 0.11, 0.1);
    b.standingTag(1, {0.42, 0.10, 0.19}, 0.10, -0.15);
    return b.world;
}

World makeFlat(std::uint64_t seed) {
    Builder b;
    Random random(seed);
    b.world.light = windowLight();
    b.world.eye = {0.01, -0.60, 0.40};
    b.world.target = {0.01, 0.10, 0.045};
    const int desk = b.tiled(Layer::Enamel, 5, {0.62, 0.62, 0.60}, 0.04);
    const int wall = b.tiled(Layer::Enamel, 3, {0.72, 0.75, 0.78}, 0.03);
    b.box({0, 0.12, -0.02}, {2.2, 1.3, 0.04}, 0, desk).lightTexels = 250;
    b.box({0, 0.66, 0.6}, {5, 0.04, 3.4}, 0, wall).lightTexels = 144;
    const V warm{0.75, 0.55, 0.4}, cool{0.4, 0.5, 0.62};
    b.box({-0.2, 0.15, 0.05}, {0.12, 0.09, 0.1}, random.range(0.2, 0.5),
          b.tiled(Layer::Enamel, 7, warm, 0.04))
        .lightTexels = 24;
    b.box({0.22, 0.2, 0.03}, {0.16, 0.12, 0.06}, random.range(-0.5, -0.2),
          b.tiled(Layer::Enamel, 7, cool, 0.04))
        .lightTexels = 24;
    const int ball = b.tiled(Layer::Enamel, 7, {0.6, 0.62, 0.45}, 0.04);
    b.ellipsoid({0.07, 0.02, 0.045}, {0.045, 0.045, 0.045}, 0, ball).lightTexels = 24;
    b.standingTag(0, {-0.02, 0.33, 0.0625}, 0.10, 0.12);
    return b.world;
}

}  // namespace mfar::synthetic
