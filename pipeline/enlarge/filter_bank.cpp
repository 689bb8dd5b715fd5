#include "pipeline/enlarge/filter_bank.h"

#include "pipeline/enlarge/prior_filters.h"
#include "pipeline/enlarge/stored_numbers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

namespace mfar {
namespace {

using namespace enlarge;

constexpr char kMagic[] = "mfarfilt";
constexpr std::size_t kMagicSize = 8;
constexpr std::array<std::uint32_t, 5> kHeader{1, kUniqueGradient, kUniqueCurvature, kTaps,
                                               kPhases};
constexpr std::size_t kHeaderSize = kMagicSize + 4 * kHeader.size();
constexpr std::size_t kWeightBytes = std::size_t{2} * kUnique * kFilterSize;
constexpr std::size_t kStoredSize = kHeaderSize + kWeightBytes + 4;

AlignedRows<std::int16_t> expanded(std::span<const FilterBank::Filter> unique, int bins,
                                   int kinds) {
    AlignedRows<std::int16_t> out({kFilterSize, bins * kinds});
    for (int bin = 0; bin < bins; ++bin) {
        const Symmetry same = Symmetry::of(bin, bins);
        for (int kind = 0; kind < kinds; ++kind) {
            const FilterBank::Filter& from = unique[same.unique * kinds + kind];
            std::int16_t* to = out[bin * kinds + kind];
            for (int tap = 0; tap < kTaps; ++tap)
                for (int phase = 0; phase < kPhases; ++phase)
                    to[filterIndex(tap, phase)] =
                        from[filterIndex(same.tap(tap), same.phase(phase))];
        }
    }
    return out;
}

/// A filter is refused if the sum of the absolute weights of one sub-pixel is larger than this.
/// Larger sums could overflow the SIMD code's 32-bit sums.
constexpr int kMostWeight = 16 * kWeightScale;

bool fits(const FilterBank::Filter& filter) {
    for (int phase = 0; phase < kPhases; ++phase) {
        int sum = 0;
        for (int tap = 0; tap < kTaps; ++tap)
            sum += std::abs(filter[filterIndex(tap, phase)]);
        if (sum > kMostWeight) return false;
    }
    return true;
}

/// Returns the weights of Keys' cubic (a = -0.75) along one axis: for each of four sub-pixels, the
/// weights of the pixels at offsets -2 to 2.
std::array<std::array<double, 5>, kGrid> cubicWeights() {
    std::array<std::array<double, 5>, kGrid> out{};
    for (int phase = 0; phase < kGrid; ++phase) {
        const double at = (phase + 0.5) / kGrid - 0.5;
        for (int x = -2; x <= 2; ++x) {
            constexpr double kA = -0.75;
            const double d = std::abs(x - at);
            out[phase][x + 2] = d <= 1  ? ((kA + 2) * d - (kA + 3)) * d * d + 1
                                : d < 2 ? ((kA * d - 5 * kA) * d + 8 * kA) * d - 4 * kA
                                        : 0;
        }
    }
    return out;
}

std::uint64_t nextNumber() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

}  // namespace

FilterBank::FilterBank(std::span<const Filter> unique, const Guidance& guidance,
                       const FineMatch& fineMatch, const StillTone& tone)
    : number_(nextNumber()), guidance_(guidance), fineMatch_(fineMatch), tone_(tone),
      cubic_({kFilterSize, 1}) {
    if (unique.size() != kUnique)
        throw FilterBankError("found filters for " + std::to_string(unique.size()) +
                              " classes; expected " + std::to_string(kUnique));
    if (!guidance.isValid())
        throw FilterBankError(
            "the guidance factors must be from 0 to 1 (still) and from 0 to 2 (video, light)");
    if (!fineMatch.isValid())
        throw FilterBankError("fine_noise must be from 0 to 4096, and fine_share from 0 to 1");
    for (std::size_t i = 0; i < unique.size(); ++i)
        if (!fits(unique[i]))
            throw FilterBankError("the filter weights of class " + std::to_string(i) +
                                  " are too large");
    gradient_ =
        expanded(unique.first(kUniqueGradient), GradientClasses::kAngles, GradientClasses::kKinds);
    curvature_ = expanded(unique.subspan(kUniqueGradient), CurvatureClasses::kAngles,
                          CurvatureClasses::kKinds);
    const auto weights = cubicWeights();
    for (int tap = 0; tap < kTaps; ++tap)
        for (int phase = 0; phase < kPhases; ++phase) {
            const auto [x, y] = kTapAt[tap];
            const double weight =
                weights[phase / kGrid][y + 2] * weights[phase % kGrid][x + 2] * kWeightScale;
            cubic_[0][filterIndex(tap, phase)] = static_cast<std::int16_t>(std::lround(weight));
        }
}

const FilterBank& FilterBank::prior() {
    static const FilterBank bank(readFilters(priorFilters(), "built-in filters"));
    return bank;
}

std::vector<std::uint8_t> storedFilters(std::span<const FilterBank::Filter> unique) {
    std::vector<std::uint8_t> out(kMagic, kMagic + kMagicSize);
    for (const std::uint32_t value : kHeader)
        putNumber(out, value, 4);
    for (const FilterBank::Filter& filter : unique)
        for (const std::int16_t weight : filter)
            putNumber(out, static_cast<std::uint16_t>(weight), 2);
    putNumber(out, fnv1a(out), 4);
    return out;
}

std::vector<FilterBank::Filter> readFilters(std::span<const std::uint8_t> bytes,
                                            const std::string& name) {
    const auto refuse = [&](const std::string& why) { throw FilterBankError(name + ": " + why); };
    if (bytes.size() < kHeaderSize || std::memcmp(bytes.data(), kMagic, kMagicSize) != 0)
        refuse("is not a filter file of mfar");
    const std::uint64_t version = getNumber(bytes.data() + kMagicSize, 4);
    if (version != kHeader[0])
        refuse("has format version " + std::to_string(version) + "; expected " +
               std::to_string(kHeader[0]));
    for (std::size_t i = 1; i < kHeader.size(); ++i)
        if (getNumber(bytes.data() + kMagicSize + 4 * i, 4) != kHeader[i])
            refuse("has other filter classes or sizes than this version of mfar");
    if (bytes.size() != kStoredSize)
        refuse("has " + std::to_string(bytes.size()) + " bytes; expected " +
               std::to_string(kStoredSize));
    if (getNumber(bytes.data() + kStoredSize - 4, 4) != fnv1a(bytes.first(kStoredSize - 4)))
        refuse("is damaged: the checksum is wrong");
    std::vector<FilterBank::Filter> out(kUnique);
    const std::uint8_t* from = bytes.data() + kHeaderSize;
    for (FilterBank::Filter& filter : out)
        for (std::int16_t& weight : filter) {
            weight = static_cast<std::int16_t>(getNumber(from, 2));
            from += 2;
        }
    return out;
}

}  // namespace mfar
