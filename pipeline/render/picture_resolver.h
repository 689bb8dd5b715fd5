#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mfar {

/// Makes the picture of a film in portions of rows, so that it fits into the time left in a frame;
/// optionally smooths the noise. Portions of one stage may run at the same time; the next stage
/// begins when all of them are done. One caller at a time, except for run().
class PictureResolver {
public:
    static constexpr int kStages = NoiseFilter::kStages + 2;

    /// Pixels outside `traced` are empty. Film and picture must outlive the work; the picture keeps
    /// its memory. `memory` is null or the film: pixels without samples or carried light then carry
    /// the filter's result, and pixels of the real surface that were not looked at take the mean of
    /// those of even column and row around them.
    void begin(const Film& film, const RenderView& view, const PixelRect& traced,
               const Exposure& exposure, bool filter, RenderedPicture& out, Film* memory = nullptr);

    struct Portion {
        int stage = 0, firstRow = 0, lastRow = 0;
        [[nodiscard]] bool empty() const { return firstRow >= lastRow; }
    };
    /// Rows with about `pixels` pixels, at least one row. Empty: wait for outstanding portions.
    [[nodiscard]] Portion next(std::int64_t pixels);
    /// Stage of the portion that next() returns, below kStages.
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
    std::vector<double> taken_, seen_;  // per row: samples, and pixels that show something
};

/// Resolves the whole picture at once.
void resolve(const Film& film, const RenderView& view, const Exposure& exposure,
             RenderedPicture& out, bool filter = false);

}  // namespace mfar
