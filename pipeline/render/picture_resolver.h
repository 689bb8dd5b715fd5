#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mfar {

/// Converts a film, which has the samples of a picture, to the picture. Optionally smooths the
/// noise. The work is divided into portions of rows, so that a portion fits into the time left in a
/// frame. Threads may run portions of the same stage at the same time. The next stage begins when
/// all portions of the stage are done. All functions except run() are for one thread at a time.
class PictureResolver {
public:
    static constexpr int kStages = NoiseFilter::kStages + 2;

    /// Begins a picture. Pixels outside `traced` become empty. Film and picture must outlive the
    /// work; the picture keeps its allocated memory.
    /// `layered`: see RenderedPicture; only if `filter` is true. `memory` is null or the film. If
    /// it is the film and `filter` is true, its pixels with neither samples nor light of the
    /// previous picture get the noise filter's result. Pixels of the real surface that were not
    /// traced show the mean of the neighbours with even column and even row.
    void begin(const Film& film, const RenderView& view, const PixelRect& traced,
               const Exposure& exposure, bool filter, RenderedPicture& out, Film* memory = nullptr,
               bool layered = false);

    /// Resizes the arrays of a later begin(), which is the only work of begin() that takes long.
    void reserve(Size size, bool filter, RenderedPicture& out);

    struct Portion {
        int stage = 0, firstRow = 0, lastRow = 0;
        [[nodiscard]] bool empty() const { return firstRow >= lastRow; }
    };
    /// A portion of about `pixels` pixels, but at least one row. Empty if the caller must wait for
    /// outstanding portions.
    [[nodiscard]] Portion next(std::int64_t pixels);
    /// Stage of the portion that next() returns, less than kStages.
    [[nodiscard]] int stage() const { return std::min(stage_, kLastStage); }
    [[nodiscard]] bool hasNext() const { return nextRow_ < rowsEnd(); }
    void run(const Portion& portion);
    void done(const Portion& portion);
    [[nodiscard]] bool complete() const { return stage_ > kLastStage; }
    [[nodiscard]] std::int64_t pixelsOf(const Portion& portion) const;

private:
    static constexpr int kPrepare = 0, kLastStage = kStages - 1;

    [[nodiscard]] int rowsBegin() const;
    [[nodiscard]] int rowsEnd() const;
    void prepare(int row);
    void write(int row);
    [[nodiscard]] Film::Resolved filtered(int x, int y);
    [[nodiscard]] LightPixel between(int x, int y) const;

    const Film* film_ = nullptr;
    Film* memory_ = nullptr;
    PixelRect traced_;
    Exposure exposure_;
    bool filters_ = false;
    RenderedPicture* out_ = nullptr;
    NoiseFilter filter_;
    int stage_ = kLastStage + 1, nextRow_ = 0, rowsOut_ = 0;
    // For each row: taken_ is the number of samples, seen_ the number of pixels with a surface.
    std::vector<double> taken_, seen_;
};

/// Converts the whole film to a picture at once.
void resolve(const Film& film, const RenderView& view, const Exposure& exposure,
             RenderedPicture& out, bool filter = false);

}  // namespace mfar
