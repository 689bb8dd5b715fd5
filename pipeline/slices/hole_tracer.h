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
/// time may call it. One exception: a thread that traces a portion may use request() and film()
/// until done() is called for the portion, also while another thread calls another function.
class HoleTracer {
public:
    /// Pixels of a request beyond `mostPixels` are dropped. `memory` is for the film.
    explicit HoleTracer(std::size_t mostPixels,
                        std::shared_ptr<FilmMemory> memory = Film::makeMemory())
        : mostPixels_(mostPixels), memory_(std::move(memory)) {}

    [[nodiscard]] bool idle() const { return stage_ == Stage::Idle; }
    /// Takes a request; requires idle(). In exchange, `request` gets the memory of an older
    /// request.
    void take(HoleRequest& request);
    [[nodiscard]] bool taken() const { return stage_ == Stage::Taken; }
    /// Sorts the pixels and drops duplicates and pixels outside the picture. Drops all pixels if
    /// the view is invalid.
    void prepare();

    /// Returns the next pixels to trace, with request().samples samples each: as many as fit into
    /// `mostSamples` samples in total, but at least one. Empty if all pixels were returned before.
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
    [[nodiscard]] std::uint64_t answered() const { return answered_; }

private:
    enum class Stage : unsigned char { Idle, Taken, Tracing };

    const std::size_t mostPixels_;
    const std::shared_ptr<FilmMemory> memory_;
    Stage stage_ = Stage::Idle;
    HoleRequest request_;
    std::size_t handed_ = 0, done_ = 0;
    std::optional<Film> film_;
    std::uint64_t answered_ = 0;
};

}  // namespace mfar
