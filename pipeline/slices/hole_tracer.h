#pragma once

#include "pipeline/render/film.h"
#include "pipeline/slices/hole_request.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace mfar {

/// Cuts one request after the other into portions. One caller at a time, except for prepare() and
/// answer(): while one of them runs, no other function may be called.
class HoleTracer {
public:
    static constexpr int kMostSamples = 256;

    /// `mostPixels`: upper limit of a request's pixels; the rest is dropped.
    explicit HoleTracer(std::size_t mostPixels) : mostPixels_(mostPixels) {}

    [[nodiscard]] bool idle() const { return stage_ == Stage::Idle; }
    /// Takes a request while idle. Swaps memory with an older request.
    void take(HoleRequest& request);
    [[nodiscard]] bool taken() const { return stage_ == Stage::Taken; }
    /// Sorts the pixels. Drops duplicates and pixels outside the picture, and all pixels if the
    /// view is invalid.
    void prepare();

    /// Pixels to be traced now, with request().samples each, at most about `mostSamples` in all.
    /// Empty: all were handed out.
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
    std::optional<Film> film_;  // has the size of the request's picture
    std::uint64_t answered_ = 0;
};

}  // namespace mfar
