#pragma once

#include "pipeline/render/film.h"
#include "pipeline/slices/hole_request.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace mfar {

/// Cuts one request after the other into portions. One caller at a time for all but prepare() and
/// answer(), during which none else is called.
class HoleTracer {
public:
    static constexpr int kMostSamples = 256;

    /// `mostPixels`: what a request has beyond is left out.
    explicit HoleTracer(std::size_t mostPixels) : mostPixels_(mostPixels) {}

    [[nodiscard]] bool idle() const { return stage_ == Stage::Idle; }
    /// Takes a request while idle, by swapping its memory with that of an older one.
    void take(HoleRequest& request);
    [[nodiscard]] bool taken() const { return stage_ == Stage::Taken; }
    /// Sorts the pixels; those twice in the list or outside the picture are left out, all of them
    /// for a view that is not sound.
    void prepare();

    /// Pixels to be traced now, request().samples each, at most about `mostSamples` in all. None:
    /// all were handed out.
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
    /// Pixels answered so far.
    [[nodiscard]] std::uint64_t answered() const { return answered_; }

private:
    enum class Stage : unsigned char { Idle, Taken, Tracing };

    const std::size_t mostPixels_;
    Stage stage_ = Stage::Idle;
    HoleRequest request_;
    std::size_t handed_ = 0, done_ = 0;
    std::optional<Film> film_;  // of the request's size
    std::uint64_t answered_ = 0;
};

}  // namespace mfar
