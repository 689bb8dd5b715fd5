#include "hal/virtual/synthetic_build.h"
#include "hal/virtual/synthetic_hash.h"

namespace mfar::synthetic {
namespace {

using V = Eigen::Vector3d;

void addTree(Builder& b, Random& random, const V& foot, double radius, double height) {
    const int bark = b.tiled(Layer::Bark, 1.1, {1, 1, 1}, 0.2);
    const int leaves = b.tiled(Layer::Foliage, 1.1, {1.1, 1.05, 1.0}, 0.4);
    b.cylinder(foot + V(0, 0, height / 2), radius, height, bark, bark).lightTexels = 24;
    for (int i = 0; i < 7; ++i) {
        const V shift{random.range(-1.1, 1.1), random.range(-0.8, 0.8), random.range(-0.45, 0.9)};
        b.ellipsoid(foot + V(0, 0, height) + shift,
                    {random.range(0.5, 0.85), random.range(0.5, 0.8), random.range(0.4, 0.65)},
                    random.range(0, 3), leaves)
            .lightTexels = 16;
    }
}

void addHouse(Builder& b) {
    const int brick = b.tiled(Layer::Brick, 1.0, {1, 1, 1}, 0.25);
    const int roof = b.tiled(Layer::Brick, 1.4, {0.7, 0.6, 0.6}, 0.2);
    const int pane = b.tiled(Layer::Enamel, 2, {0.06, 0.08, 0.11}, 0.5, 1.0);
    const int frame = b.tiled(Layer::Wood, 3, {1.3, 1.6, 2.2}, 0.1);
    constexpr double kYaw = 0.12;
    const V centre{6.8, 15, 2}, size{6, 7, 4.6};
    b.box(centre, size, kYaw, {brick, brick, roof}).lightTexels = 64;
    const Eigen::AngleAxisd turn(kYaw, V::UnitZ());
    const auto on = [&](double x, double y, double z) -> V { return centre + turn * V(x, y, z); };
    for (const double x : {-1.9, 0.3}) {
        b.box(on(x, -3.48, 0.2), {0.95, 0.06, 1.3}, kYaw, pane);
        b.box(on(x, -3.51, 0.2), {0.05, 0.06, 1.3}, kYaw, frame);
        b.box(on(x, -3.51, 0.45), {0.95, 0.06, 0.04}, kYaw, frame);
        b.box(on(x, -3.54, -0.49), {1.15, 0.16, 0.08}, kYaw, frame);
    }
    b.box(on(-2.98, -0.5, 0.2), {0.06, 0.95, 1.3}, kYaw, pane);
    b.box(on(-3.01, -0.5, 0.2), {0.06, 0.05, 1.3}, kYaw, frame);
    b.box(on(-3.04, -0.5, -0.49), {0.16, 1.15, 0.08}, kYaw, frame);
}

void addFence(Builder& b, Random& random) {
    const int wood = b.tiled(Layer::Wood, 1.7, {0.85, 0.85, 0.9}, 0.3, 0.05);
    for (int i = 0; i < 9; ++i) {
        const double x = -4.2 + 0.62 * i;
        b.box({x, 5.2, 0.45}, {0.09, 0.03, 0.9 + random.range(-0.05, 0.05)}, 0, wood);
    }
    for (const double z : {0.28, 0.68})
        b.box({-1.72, 5.235, z}, {5.2, 0.03, 0.08}, 0, wood);
}

}  // namespace

World makeOutdoor(std::uint64_t seed) {
    Builder b;
    Random random(seed);
    Lighting& light = b.world.light;
    light.towards = V(-0.5, -0.45, 0.75).normalized();
    light.spread = 0.03;
    light.key = {1.02, 0.94, 0.80};
    light.ambient = {0.24, 0.28, 0.36};
    light.background = {0.45, 0.6, 0.85};
    b.world.eye = {0, 0, 1.55};
    b.world.target = {0.15, 6, 1.25};

    const int gravel = b.tiled(Layer::Gravel, 0.8, {1, 1, 1}, 0.35);
    const int grass = b.tiled(Layer::Foliage, 1.3, {1.15, 1.1, 1.0}, 0.5);
    b.box({0, 30, -0.1}, {140, 70, 0.2}, 0, grass).lightTexels = 112;
    b.box({0.9, 14, 0.01}, {2.6, 36, 0.04}, 0.04, gravel).lightTexels = 96;
    // The texture repeats four times along the width, so that the distant trees have detail that
    // only the still resolves. Spread over the whole width, it would be too coarse for that.
    const int sky = b.sheet(Layer::Forest, 24, 44, {1.0, 1.0, 1.0});
    b.box({0, 58, 14}, {96, 0.5, 44}, 0, sky);

    addHouse(b);
    addTree(b, random, {-2.3, 6.8, 0}, 0.21, 3.3);
    addTree(b, random, {2.4, 8.6, 0}, 0.17, 3.1);
    addTree(b, random, {-6.4, 12.5, 0}, 0.3, 4.2);
    addTree(b, random, {-1.6, 19, 0}, 0.3, 4.5);
    const int hedge = b.tiled(Layer::Foliage, 1.4, {0.85, 0.95, 0.9}, 0.4);
    for (int i = 0; i < 6; ++i)
        b.ellipsoid({-6.5 + 1.05 * i, 9.3 + random.range(-0.2, 0.2), 0.45},
                    {0.85, 0.6, random.range(0.65, 0.95)}, random.range(0, 3), hedge)
            .lightTexels = 16;
    addFence(b, random);
    const int bark = b.tiled(Layer::Bark, 2.2, {1, 1, 1}, 0.2);
    b.rod({1.05, 2.75, 0.12}, {2.1, 3.1, 0.12}, 0.12, bark).lightTexels = 24;
    const int post = b.tiled(Layer::Wood, 2.5, {0.8, 0.75, 0.7}, 0.2);
    b.box({0.55, 3.43, 0.6}, {0.07, 0.05, 1.25}, 0, post);
    b.standingTag(0, {0.55, 3.40, 1.25}, 0.34, 0.05);
    b.standingTag(1, {-0.95, 5.18, 0.65}, 0.40, 0);
    return b.world;
}

}  // namespace mfar::synthetic
