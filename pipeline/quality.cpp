#include "pipeline/quality.h"

#include <stdexcept>

namespace mfar {

void validate(const Quality& quality) {
    validate(quality.flow2d);
    validate(quality.epipolar);
    if (!(quality.detailShare > 0 && quality.detailShare <= 1))
        throw std::invalid_argument("detailShare must be above 0 and at most 1");
    if (!(quality.secondShare >= 0 && quality.secondShare <= 1))
        throw std::invalid_argument("secondShare must be from 0 to 1");
    if (!(quality.depthEvery >= 1 && quality.depthEvery <= 60))
        throw std::invalid_argument("depthEvery must be from 1 to 60");
}

}  // namespace mfar
