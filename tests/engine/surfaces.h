#pragma once

#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/flow_chooser.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/flow_choice.h"
#include "tests/engine/pictures.h"
#include "tests/engine/seen_still.h"
#include "tests/oracle/subpixel.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <vector>

namespace mfar {

inline constexpr Size kSurfacesVideo{158, 94};
inline constexpr double kSurfacesNoise = 1;

/// Size of a still with 3.6 pixels per video pixel along each axis.
inline Size stillOf(Size video) {
    return {video.width * 18 / 5, video.height * 18 / 5};
}

/// Waves in several directions. Their lengths are 1.7 to 65 video pixels.
inline double surfaceTexture(const Eigen::Vector2d& p) {
    double sum = 128;
    for (int k = 0; k < 10; ++k) {
        const double angle = 0.9 * k, wave = 0.027 * std::pow(1.5, k);
        sum += 11 * std::sin(wave * (std::cos(angle) * p.x() + std::sin(angle) * p.y()) + k);
    }
    return sum;
}

/// Column of cells at which another surface begins, with a step of the flow [px].
inline constexpr int kEdge = 22;
inline constexpr int kStep = 3;

inline Eigen::Vector2d surfaceFlow(const Eigen::Vector2d& p) {
    const double step = p.x() >= kCell * kEdge - 0.5 ? kStep : 0;
    return {2.3 + 0.012 * p.x() - 0.006 * p.y() + step, -1.6 - 0.004 * p.x() + 0.02 * p.y()};
}

inline Eigen::Vector2d middleOf(int x, int y) {
    return {kCell * x + 1.5, kCell * y + 1.5};
}

/// Two surfaces, and a given flow with errors of 0.15 px (standard deviation along each axis). Some
/// tiles are not matched, and some cells are not shown in the still. `light`: see SeenStill.
struct Surfaces : SeenStill {
    explicit Surfaces(Size video = kSurfacesVideo,
                      decltype(&surfaceTexture) texture = surfaceTexture, double light = 0)
        : SeenStill(bentRig(video, stillOf(video)), texture, surfaceFlow, light),
          cells(cellsOf(video)), work(TileWork::everything(tilesOf(video))) {
        work.noise = kSurfacesNoise;
        for (std::size_t i = 0; i < work.flags.size(); ++i)
            work.flags[i].matched = i % 11 != 3 ? 1 : 0;
        std::mt19937 random(1);
        std::normal_distribution<float> error(0, 0.15F);
        for (int y = 0; y < cells.height; ++y)
            for (int x = 0; x < cells.width; ++x) {
                const Eigen::Vector2f flow = surfaceFlow(middleOf(x, y)).cast<float>();
                given.push_back({flow.x() + error(random), flow.y() + error(random), 0.1F, 9000});
                errors.push_back({random() % 16 == 0 ? 1e4F : 0});
            }
    }

    /// Gives some cells beside the edge the flow that the surface on its left would have there.
    void confuse() {
        for (int y = 0; y < cells.height; ++y)
            if (y % 3 != 1) given[index(kEdge, y)].x -= kStep;
    }
    [[nodiscard]] bool isMatched(int x, int y) const {
        return work.at(x / kCellsPerTile, y / kCellsPerTile).matched != 0;
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * cells.width + x;
    }
    [[nodiscard]] double errorOf(const FlowCell& cell, int x, int y) const {
        return (Eigen::Vector2d(cell.x, cell.y) - surfaceFlow(middleOf(x, y))).norm();
    }

    const Size cells;
    TileWork work;
    std::vector<FlowCell> given;
    std::vector<ErrorCell> errors;
};

/// The flow and the errors as the GLES engine stores them.
struct SurfacesOnGpu {
    SurfacesOnGpu(const Surfaces& in, bool usesErrors)
        : cells(2 * in.given.size() * sizeof(FlowCell)), tiles(in.rig.video.size),
          fields{0, usesErrors ? static_cast<int>(in.given.size()) : -1} {
        cells.write(std::span(in.given), 0);
        cells.write(std::span(in.errors), in.given.size() * sizeof(FlowCell));
        tiles.set(in.work);
    }
    gpu::Buffer cells;
    TileBuffer tiles;
    FlowChooser::Fields fields;
};

/// Returns the surfaces with the flow that the cells choose.
inline Surfaces chosenOnHost(const Surfaces& in, bool usesErrors = true, float light = 0) {
    Surfaces out = in;
    simd::ComparedCells cells(in.rig.video.size);
    for (int row = 0; row < cells.cells.height; ++row)
        cells.take(row, in.work, in.given.data(), usesErrors ? in.errors.data() : nullptr);
    const simd::StillPairs still = in.pairs();
    simd::FlowChoice(in.rig, std::make_shared<Workers>(2), cells)
        .run({in.video, still, light, in.work, out.given.data()});
    return out;
}

inline Surfaces chosenOnGpu(const Surfaces& in, bool usesErrors = true, float light = 0) {
    const SurfacesOnGpu on(in, usesErrors);
    FlowChooser chooser(in.rig);
    const auto chosen =
        chooser.run(on.cells, on.fields, in.videoTexture(), in.stillTexture(), light, on.tiles)
            .read<std::array<float, 4>>(in.given.size(), 0);
    Surfaces out = in;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        out.given[i].x = chosen[i][0];
        out.given[i].y = chosen[i][1];
    }
    return out;
}

inline twin::SubpixelCase oracleOf(const Surfaces& in, bool usesErrors, float light) {
    twin::SubpixelCase out{in.rig, in.grey, in.still, in.cells, {}, {}, in.work.noise, light};
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x) {
            const std::size_t i = in.index(x, y);
            const Size video = in.rig.video.size;
            const bool isWhole = kCell * (x + 1) <= video.width && kCell * (y + 1) <= video.height;
            out.flow.emplace_back(in.given[i].x, in.given[i].y);
            out.compared.push_back(in.isMatched(x, y) && isWhole &&
                                   (!usesErrors || in.errors[i].error < params::kNotShown));
        }
    return out;
}

}  // namespace mfar
