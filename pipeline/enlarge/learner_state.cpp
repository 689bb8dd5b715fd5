#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/stored_numbers.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <string>

namespace mfar {
namespace {

using namespace enlarge;

constexpr char kMagic[] = "mfarlern";
constexpr std::size_t kMagicSize = 8;
constexpr std::array<std::uint64_t, 4> kHeader{8, kUnique, kTaps, kPhases};
// Older versions of the format, which can still be read. Version 1 has no guidance. Version 2 has
// one factor of guidance (ten numbers); it is skipped and learned again. Version 3 has the factors
// `still` and `video`, but no FineMatch. Version 4 has no tone curve. In versions 4 and 5,
// FineMatch was measured within blocks of 2x2 pixels; it is skipped and learned again. Versions 5
// and 6 do not store whether the tone curve is used; it then counts as used. Only version 8 has
// numbers of Guidance::light, at the end of the file.
constexpr std::uint64_t kWithoutGuidance = 1, kOneFactor = 2, kTwoFactors = 3, kWithoutTone = 4,
                        kFineInBlocks = 5, kToneInUse = 6, kWithoutLight = 7;
constexpr int kOneFactorNumbers = 10;
constexpr std::size_t kChecksumSize = 4;
constexpr std::size_t kMostKeySize = 4096;

class Writer {
public:
    void number(std::uint64_t value) { putNumber(out_, value, 8); }
    void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
    void text(const std::string& text) {
        number(text.size());
        out_.insert(out_.end(), text.begin(), text.end());
    }
    void weights(const ClassWeights& weights) {
        for (const std::int16_t weight : roundedFilter(weights))
            putNumber(out_, static_cast<std::uint16_t>(weight), 2);
    }
    void sums(const ClassSums& sums) {
        for (int i = 0; i < kTaps; ++i)
            for (int j = 0; j <= i; ++j)
                number(sums.taps(i, j));
        for (int i = 0; i < kTaps; ++i)
            for (int j = 0; j < kPhases; ++j)
                number(sums.products(i, j));
        number(sums.squares);
        number(sums.pixels);
    }
    [[nodiscard]] std::vector<std::uint8_t> finished() && {
        putNumber(out_, fnv1a(out_), kChecksumSize);
        return std::move(out_);
    }

private:
    std::vector<std::uint8_t> out_{kMagic, kMagic + kMagicSize};
};

class Reader {
public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& name)
        : bytes_(bytes), name_(name) {
        if (bytes.size() < kMagicSize + kChecksumSize ||
            std::memcmp(bytes.data(), kMagic, kMagicSize) != 0)
            refuse("is not a file of learned filters of mfar");
        at_ = kMagicSize;
        version_ = bytes_.size() >= at_ + 8 ? getNumber(&bytes_[at_], 8) : kHeader[0];
        if (version_ < kWithoutGuidance || version_ > kHeader[0])
            refuse("has a format version that this version of mfar does not support");
        bytes_ = bytes.first(bytes.size() - kChecksumSize);
        if (getNumber(bytes.data() + bytes_.size(), kChecksumSize) != fnv1a(bytes_))
            refuse("is damaged: the checksum is wrong");
    }
    [[noreturn]] void refuse(const std::string& why) const {
        throw FilterBankError(name_ + ": " + why);
    }
    [[nodiscard]] std::uint64_t version() const { return version_; }
    std::uint64_t number() { return getNumber(take(8), 8); }
    double real() {
        const auto out = std::bit_cast<double>(number());
        if (!std::isfinite(out)) refuse("has numbers that are not finite");
        return out;
    }
    void reals(std::span<double> out) {
        for (double& value : out)
            value = real();
    }
    template <std::size_t Count>
    std::array<double, Count> reals() {
        std::array<double, Count> out{};
        reals(out);
        return out;
    }
    std::string text() {
        const std::uint64_t size = number();
        if (size > kMostKeySize)
            refuse("stores a name of more than 4096 bytes for the pair of sensors");
        const std::uint8_t* from = take(size);
        return {from, from + size};
    }
    ClassWeights weights() {
        FilterBank::Filter out;
        for (std::int16_t& weight : out)
            weight = static_cast<std::int16_t>(getNumber(take(2), 2));
        return weightsOf(out);
    }
    ClassSums sums() {
        ClassSums out;
        for (int i = 0; i < kTaps; ++i)
            for (int j = 0; j <= i; ++j)
                out.taps(i, j) = out.taps(j, i) = real();
        for (int i = 0; i < kTaps; ++i)
            for (int j = 0; j < kPhases; ++j)
                out.products(i, j) = real();
        out.squares = real();
        out.pixels = real();
        return out;
    }
    std::array<double, ToneLearner::kNumbers> tone() {
        std::array<double, ToneLearner::kNumbers> out{};
        reals(std::span(out).first(ToneSums::kNumbers));
        out.back() = version_ > kToneInUse ? real() : 1;
        return out;
    }
    void finish() const {
        if (at_ != bytes_.size()) refuse("is longer than this program expects");
    }

private:
    const std::uint8_t* take(std::size_t size) {
        if (size > bytes_.size() - at_) refuse("is shorter than this program expects");
        at_ += size;
        return bytes_.data() + at_ - size;
    }

    std::span<const std::uint8_t> bytes_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::uint64_t version_ = 0;
};

}  // namespace

std::vector<std::uint8_t> EnlargerLearner::stored(const std::string& key) const {
    Writer out;
    for (const std::uint64_t value : kHeader)
        out.number(value);
    out.text(key);
    for (const std::uint64_t value : {counts_.stills, counts_.repeated, counts_.refused})
        out.number(value);
    for (int i = 0; i < kUnique; ++i) {
        const auto n = static_cast<std::size_t>(i);
        out.number(std::uint64_t{learned_[n]});
        out.weights(current_[n]);
        out.sums(sums_[i]);
        out.sums(held_[i]);
    }
    const auto guidance = guidance_.stored();
    for (const double value : std::span(guidance).first(GuidanceLearner::kOldNumbers))
        out.number(value);
    for (const double value : fineMatch_.stored())
        out.number(value);
    for (const double value : tone_.stored())
        out.number(value);
    for (const double value : std::span(guidance).subspan(GuidanceLearner::kOldNumbers))
        out.number(value);
    return std::move(out).finished();
}

EnlargerLearner EnlargerLearner::restored(std::span<const std::uint8_t> bytes,
                                          const std::string& key, const std::string& name) {
    Reader in(bytes, name);
    for (const std::uint64_t value : {in.version(), kHeader[1], kHeader[2], kHeader[3]})
        if (in.number() != value)
            in.refuse("has other filter classes or sizes than this version of mfar");
    if (in.text() != key) in.refuse("was learned from another pair of sensors");
    EnlargerLearner out;
    for (std::uint64_t* value : {&out.counts_.stills, &out.counts_.repeated, &out.counts_.refused})
        *value = in.number();
    std::vector<ClassWeights> weights;
    std::vector<bool> learned;
    for (int i = 0; i < kUnique; ++i) {
        learned.push_back(in.number() != 0);
        weights.push_back(in.weights());
        out.sums_.edit(i) = in.sums();
        out.held_.edit(i) = in.sums();
    }
    if (in.version() == kOneFactor)  // Skips the numbers; guidance is learned again.
        for (int i = 0; i < kOneFactorNumbers; ++i)
            (void)in.real();
    std::array<double, GuidanceLearner::kNumbers> guidance{};
    const auto ofLight = std::span(guidance).subspan(GuidanceLearner::kOldNumbers);
    if (in.version() >= kTwoFactors)
        in.reals(std::span(guidance).first(GuidanceLearner::kOldNumbers));
    if (in.version() >= kWithoutTone) {
        const auto fineMatch = in.reals<FineMatchLearner::kNumbers>();
        if (in.version() > kFineInBlocks && !out.fineMatch_.restore(fineMatch))
            in.refuse("has values of fine_noise or fine_share that are out of range");
    }
    if (in.version() >= kFineInBlocks && !out.tone_.restore(in.tone()))
        in.refuse("has values of the tone curve that are out of range");
    if (in.version() > kWithoutLight) in.reals(ofLight);
    if (!out.guidance_.restore(guidance)) in.refuse("has guidance factors that are out of range");
    in.finish();
    if (!out.putInPlace(weights, learned)) in.refuse("has filter weights that are too large");
    out.measure();
    if (!std::isfinite(out.counts_.gainDb) || !std::isfinite(out.counts_.priorDb))
        in.refuse("has least-squares sums that are too large");
    return out;
}

}  // namespace mfar
