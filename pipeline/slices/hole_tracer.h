#pragma once

#include "pipeline/render/film.h"
#include "pipeline/slices/hole_request.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace mfar {

/// Divides hole requests into portions to trace, one request after the other. Only one thread at a
/// time may call it. While prepare() or answer() runs, no other function may be called.
class HoleTracer {
public:
    static constexpr int kMostSamples = 256;

    /// `mostPixels`: largest number of pixels of a request. Further pixels are dropped. `memory` is
    /// for the film.
    explicit HoleTracer(std::size_t mostPixels,
                        std::shared_ptr<FilmMemory> memory = Film::makeMemory())
        : mostPixels_(mostPixels), memory_(std::move(memory)) {}

    [[nodiscard]] bool idle() const { return stage_ == Stage::Idle; }
    /// Takes a request; only allowed while idle(). `request` gets the memory of an older request.
    void take(HoleRequest& request);
    [[nodiscard]] bool taken() const { return stage_ == Stage::Taken; }
    /// Sorts the pixels. Drops duplicates and pixels outside the picture. Drops all pixels if the
    /// view is invalid.
    void prepare();

    /// Pixels to trace now, with request().samples samples each. In total, these are at most
    /// `mostSamples` samples, but at least one pixel. Empty if all pixels were handed out.
    [[nodiscard]] std::span<const std::uint32_t> next(std::int64_t mostSamples);
    void done(std::span<const std::uint32_t> pixels) { done_ += pixels.size(); }
    [[nodiscard]] bool tracing() const {
        return stage_ == Stage::Tracing && handed_ < request_.pixels.size();
    }
    [[nodiscard]] bool complete() const {
        return stage_ == Stage::Tracing && done_ == request_.pixels.size();
    }
    void answer(const Exposure& exposure, HoleAnswer& out);

    [[nodiscard]] const HoleRequest& request() const { return request_; }
    [[nodiscard]] Film& film() { return *film_; }
    /// Number of pixels answered since the start.
    [[nodiscard]] std::uint64_t answered() const { return answered_; }

private:
    enum class Stage : unsigned char { Idle, Taken, Tracing };

    const std::size_t mostPixels_;
    const std::shared_ptr<FilmMemory> memory_;
    Stage stage_ = Stage::Idle;
    HoleRequest request_;
    std::size_t handed_ = 0, done_ = 0;
    std::optional<Film> film_;  // has the size of the requested view
    std::uint64_t answered_ = 0;
};

}  // namespace mfar
