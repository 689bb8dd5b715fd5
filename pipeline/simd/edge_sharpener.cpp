#include "pipeline/simd/edge_sharpener.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mfar::simd {
namespace {

constexpr int kLeastContrast = 3;  // pixels with a lower contrast level do not look blurred

std::uint8_t channel(std::uint32_t colour, unsigned c) {
    return static_cast<std::uint8_t>(colour >> 8 * c);
}

/// The class Contrasts computes a contrast level in [0, kLevels) for each pixel of a row. The level
/// is proportional to the largest difference of a colour channel within 3x3 pixels. Empty pixels of
/// the layer are black. So the level at an object's outline does not depend on the real background.
class Contrasts {
public:
    explicit Contrasts(const PixelRect& where)
        : where_(where), low_(static_cast<std::size_t>(where.x1 - where.x0)), high_(low_.size()),
          levels_(low_.size()) {}

    const std::vector<std::uint8_t>& at(Rows<const std::uint32_t> colour, int y) {
        std::ranges::fill(levels_, std::uint8_t{0});
        for (unsigned c = 0; c < 3; ++c) {
            std::ranges::fill(low_, std::uint8_t{255});
            std::ranges::fill(high_, std::uint8_t{0});
            for (int v = std::max(y - 1, where_.y0); v <= std::min(y + 1, where_.y1 - 1); ++v)
                addRow(colour[v] + where_.x0, c);
            widen();
        }
        for (std::uint8_t& level : levels_)
            level = static_cast<std::uint8_t>(
                std::min(level * EdgeSharpener::kLevels / 255, EdgeSharpener::kLevels - 1));
        return levels_;
    }

private:
    void addRow(const std::uint32_t* row, unsigned c) {
        for (std::size_t x = 0; x < low_.size(); ++x) {
            const std::uint8_t value = channel(row[x], c);
            low_[x] = std::min(low_[x], value);
            high_[x] = std::max(high_[x], value);
        }
    }
    void widen() {
        const std::size_t last = low_.size() - 1;
        for (std::size_t x = 0; x <= last; ++x) {
            const std::size_t left = x > 0 ? x - 1 : 0, right = std::min(x + 1, last);
            const int low = std::min({low_[left], low_[x], low_[right]});
            const int high = std::max({high_[left], high_[x], high_[right]});
            levels_[x] = std::max(levels_[x], static_cast<std::uint8_t>(high - low));
        }
    }

    PixelRect where_;
    std::vector<std::uint8_t> low_, high_, levels_;
};

}  // namespace

EdgeSharpener::EdgeSharpener(Size layer, double share, int most, int fadeFrames)
    : layer_(layer), share_(share), step_(fadeFrames > 0 ? 1.0 / fadeFrames : 1),
      most_(static_cast<std::size_t>(most)) {}

void EdgeSharpener::drop() {
    isListed_ = false;
    listed_.clear();
    shown_ = 0;
}

void EdgeSharpener::list(Rows<const std::uint32_t> colour, Rows<const std::uint32_t> state,
                         const PixelRect& where) {
    drop();
    if (where.empty()) return;
    std::array<std::vector<std::array<std::uint32_t, 2>>, kLevels> byLevel;
    std::size_t objects = 0;
    Contrasts contrasts(where);
    for (int y = where.y0; y < where.y1; ++y) {
        const std::vector<std::uint8_t>& levels = contrasts.at(colour, y);
        for (int x = where.x0; x < where.x1; ++x) {
            const std::uint32_t id = state[y][x] >> 24, level = levels[x - where.x0];
            objects += id > 0 && id < 255 ? 1 : 0;
            if (level < kLeastContrast) continue;
            byLevel[level].push_back(
                {static_cast<std::uint32_t>(y) * layer_.width + x, colour[y][x]});
        }
    }
    const auto most = std::min(
        static_cast<std::size_t>(static_cast<float>(share_) * static_cast<float>(objects)), most_);
    listed_ = byLevel.back();
    for (int l = kLevels - 2; l >= kLeastContrast; --l) {
        const auto& level = byLevel[static_cast<std::size_t>(l)];
        if (listed_.size() + level.size() > most) break;
        listed_.insert(listed_.end(), level.begin(), level.end());
    }
    std::ranges::sort(listed_);
    isListed_ = true;
}

std::optional<std::vector<std::uint32_t>> EdgeSharpener::take() {
    if (!isListed_) return {};
    isListed_ = false;
    std::vector<std::uint32_t> out;
    for (const auto& [pixel, colour] : listed_)
        out.push_back(pixel);
    return out;
}

void EdgeSharpener::answer(const HoleAnswer& answer) {
    entries_.clear();
    auto before = listed_.begin();
    for (std::size_t i = 0; i < answer.pixels.size() && entries_.size() < most_; ++i) {
        const std::uint32_t pixel = answer.pixels[i];
        while (before != listed_.end() && (*before)[0] < pixel)
            ++before;
        if (before == listed_.end() || (*before)[0] != pixel) continue;
        entries_.push_back({pixel, (*before)[1], std::bit_cast<std::uint32_t>(answer.colour[i])});
    }
    if (!entries_.empty()) shown_ = step_;
}

void EdgeSharpener::show(Rows<std::uint32_t> colour) {
    if (shown_ == 0) return;
    for (const Entry& entry : entries_) {
        std::uint32_t mixed = 0;
        for (unsigned c = 0; c < 4; ++c) {
            const double from = channel(entry.before, c), to = channel(entry.rendered, c);
            mixed |= static_cast<std::uint32_t>(std::lround(from + shown_ * (to - from))) << 8 * c;
        }
        const auto width = static_cast<std::uint32_t>(layer_.width);
        colour[static_cast<int>(entry.pixel / width)][entry.pixel % width] = mixed;
    }
    shown_ = std::min(1.0, shown_ + step_);
}

}  // namespace mfar::simd
