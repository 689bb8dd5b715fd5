#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mfar {

/// Makes the picture of a film, with its noise smoothed if wanted, in portions of rows: so that it
/// takes no more of a frame's time than there is. Portions of one stage may run at the same time;
/// the next stage begins when all of them are done. One caller at a time but for run().
class PictureResolver {
public:
    static constexpr int kStages = NoiseFilter::kStages + 2;

    /// There is something in `traced` alone. Film and picture must stay until it is complete; the
    /// picture keeps its memory. `memory`, if given, is the film: its pixels carry what the filter
    /// finds for them where nothing else is known, and the real surface's that nobody looked at
    /// take after those of even column and row around them.
    void begin(const Film& film, const RenderView& view, const PixelRect& traced,
               const Exposure& exposure, bool filter, RenderedPicture& out, Film* memory = nullptr);

    struct Portion {
        int stage = 0, firstRow = 0, lastRow = 0;
        [[nodiscard]] bool empty() const { return firstRow >= lastRow; }
    };
    /// Rows of about so many pixels, one at least. Empty: wait for those that are out.
    [[nodiscard]] Portion next(std::int64_t pixels);
    /// What next() gives a portion of, below kStages.
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
    std::vector<double> taken_, seen_;  // samples and pixels that show something, of each row
};

/// All of it at once.
void resolve(const Film& film, const RenderView& view, const Exposure& exposure,
             RenderedPicture& out, bool filter = false);

}  // namespace mfar
