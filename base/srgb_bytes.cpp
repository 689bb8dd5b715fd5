#include "base/srgb_bytes.h"

#include <cmath>

namespace mfar {

const std::array<float, 256>& linearOfSrgbByte() {
    static const std::array<float, 256> kTable = [] {
        std::array<float, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            const float encoded = static_cast<float>(i) / 255;
            table[i] = encoded <= 0.04045F ? encoded / 12.92F
                                           : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
        }
        return table;
    }();
    return kTable;
}

}  // namespace mfar
