#include "daemon/tools/calibrate/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace mfar::calibration {

Coverage::Coverage(Size picture)
    : picture_(picture), counts_(static_cast<std::size_t>(kColumns) * kRows) {}

void Coverage::add(const std::vector<Corner>& corners) {
    for (const Corner& c : corners) {
        const double x = (c.pixel.x() + 0.5) / picture_.width * kColumns;
        const double y = (c.pixel.y() + 0.5) / picture_.height * kRows;
        const int column = std::clamp(static_cast<int>(x), 0, kColumns - 1);
        const int row = std::clamp(static_cast<int>(y), 0, kRows - 1);
        ++counts_[static_cast<std::size_t>(row) * kColumns + column];
    }
}

double Coverage::share() const {
    const auto seen = std::ranges::count_if(counts_, [](int n) { return n > 0; });
    return static_cast<double>(seen) / static_cast<double>(counts_.size());
}

std::string Coverage::emptiest() const {
    constexpr std::array<const char*, 9> kParts{
        "the top left", "the top",         "the top right", "the left",        "the middle",
        "the right",    "the bottom left", "the bottom",    "the bottom right"};
    std::array<int, 9> empty{};
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            if (counts_[static_cast<std::size_t>(row) * kColumns + column] == 0)
                ++empty[row * 3 / kRows * 3 + column * 3 / kColumns];
    return kParts[std::ranges::max_element(empty) - empty.begin()];
}

std::vector<std::string> Coverage::map() const {
    constexpr std::string_view kShades = " .:+*#";
    std::vector<std::string> out(kRows, std::string(kColumns, ' '));
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const int n = counts_[static_cast<std::size_t>(row) * kColumns + column];
            const int shade = n == 0 ? 0 : 1 + static_cast<int>(std::log2(n) / 2);
            out[row][column] = kShades[std::min<int>(shade, kShades.size() - 1)];
        }
    }
    return out;
}

}  // namespace mfar::calibration
