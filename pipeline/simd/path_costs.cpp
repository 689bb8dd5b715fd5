#include "pipeline/simd/path_costs.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/path_costs.cpp"
#include <hwy/foreach_target.h>
// The next header is compiled once per instruction set, so it must come after foreach_target.h.
#include "pipeline/simd/path_blocks-inl.h"
#include "pipeline/simd/path_windows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {

std::size_t PathScratch(int vectors, int columns) {
#if HWY_TARGET != HWY_SCALAR
    if (vectors == 1) return 0;
#endif
    return strideOf(vectors) * (std::max(columns, 1) + 1);
}

void PathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch) {
#if HWY_TARGET != HWY_SCALAR
    if (volume.vectors == 1) {
        int y = first;
        for (; y + kBlocks <= last; y += kBlocks)
            blocksAlongRows<kBlocks>(volume, y);
        for (; y < last; ++y)
            blocksAlongRows<1>(volume, y);
        return;
    }
#endif
    for (int y = first; y < last; ++y)
        windowsAlongRow(volume, y, scratch);
}

void PathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out) {
#if HWY_TARGET != HWY_SCALAR
    if (volume.vectors == 1) {
        for (int x = first; x < last; x += kColumnsTogether)
            blocksAlongColumns(volume, x, std::min(x + kColumnsTogether, last), out);
        return;
    }
#endif
    windowsAlongColumns(volume, first, last, scratch, out);
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(PathScratch);
HWY_EXPORT(PathsAlongRows);
HWY_EXPORT(PathsAlongColumns);

std::size_t pathScratch(int vectors, int columns) {
    return HWY_DYNAMIC_DISPATCH(PathScratch)(vectors, columns);
}

void pathsAlongRows(const PathVolume& volume, int first, int last, std::uint8_t* scratch) {
    HWY_DYNAMIC_DISPATCH(PathsAlongRows)(volume, first, last, scratch);
}

void pathsAlongColumns(const PathVolume& volume, int first, int last, std::uint8_t* scratch,
                       Valley* out) {
    HWY_DYNAMIC_DISPATCH(PathsAlongColumns)(volume, first, last, scratch, out);
}

}  // namespace mfar::simd
#endif
