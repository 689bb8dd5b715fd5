#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mfar {

/// Converts a film to a picture, with or without a noise filter. The work is divided into portions
/// of rows that fit into the time left in a frame. Threads may run portions of the same stage at
/// the same time. A stage begins when the previous stage is complete. All functions except run()
/// must be called by one thread at a time.
class PictureResolver {
public:
    static constexpr int kStages = NoiseFilter::kStages + 2;

    /// Begins a picture. Pixels outside `traced` become empty. `film` and `out` must exist until
    /// the picture is complete.
    /// `layered` has an effect only if `filter` is true; see RenderedPicture.
    /// With a filter, a pixel through which no ray was traced gets the mean of its neighbours with
    /// even column and even row that show the shadow catcher.
    void begin(const Film& film, const RenderView& view, const PixelRect& traced,
               const Exposure& exposure, bool filter, RenderedPicture& out, bool layered = false);

    /// Resizes the arrays for a later begin(), which then takes little time.
    void reserve(Size size, bool filter, RenderedPicture& out);

    struct Portion {
        int stage = 0, firstRow = 0, lastRow = 0;
        [[nodiscard]] bool empty() const { return firstRow >= lastRow; }
    };
    /// Returns a portion of about `pixels` pixels, at least one row. The portion is empty if the
    /// picture is complete, or if the next stage must wait for running portions.
    [[nodiscard]] Portion next(std::int64_t pixels);
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
    [[nodiscard]] bool isTraced(std::size_t pixel) const {
        return film_->isSeen(pixel) || film_->samples(pixel) > 0;
    }
    [[nodiscard]] Film::Resolved filtered(int x, int y) const;
    [[nodiscard]] LightPixel between(int x, int y) const;

    const Film* film_ = nullptr;
    PixelRect traced_;
    Exposure exposure_;
    bool filters_ = false;
    RenderedPicture* out_ = nullptr;
    NoiseFilter filter_;
    int stage_ = kLastStage + 1, nextRow_ = 0, rowsOut_ = 0;
    std::vector<double> taken_, seen_;
};

/// Converts the whole film to a picture at once.
void resolve(const Film& film, const RenderView& view, const Exposure& exposure,
             RenderedPicture& out, bool filter = false);

}  // namespace mfar
