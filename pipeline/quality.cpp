#include "pipeline/quality.h"

#include <stdexcept>

namespace mfar {

void validate(const Quality& quality) {
    validate(quality.flow2d);
    validate(quality.epipolar);
    if (!(quality.detailShare > 0 && quality.detailShare <= 1))
        throw std::invalid_argument("detailShare is not in (0, 1]");
    if (!(quality.secondShare >= 0 && quality.secondShare <= 1))
        throw std::invalid_argument("secondShare is not in [0, 1]");
    if (!(quality.depthEvery >= 1 && quality.depthEvery <= 60))
        throw std::invalid_argument("depthEvery is not in [1, 60]");
}

}  // namespace mfar
