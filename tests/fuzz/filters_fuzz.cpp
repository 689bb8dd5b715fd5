// Fuzzes the state of the learned filters. The input is a list of edits of a valid file. In each
// edit, two bytes select a position (in 64ths of the file, plus an offset). The third byte is the
// number of following bytes that replace those at the position; 0 truncates the file there and ends
// the list. After the last edit, the checksum is corrected, because otherwise every input would be
// refused.
#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/stored_numbers.h"
#include "tests/fuzz/target.h"

#include <algorithm>

namespace {

using namespace mfar;

constexpr std::size_t kChecksum = 4;

void putChecksum(std::vector<std::uint8_t>& file) {
    if (file.size() < kChecksum) return;
    file.resize(file.size() - kChecksum);
    enlarge::putNumber(file, enlarge::fnv1a(file), kChecksum);
}

std::vector<std::uint8_t> edited(std::vector<std::uint8_t> file, std::span<const std::uint8_t> in) {
    while (in.size() > 3) {
        const std::size_t at =
            (in[0] / 4U) * file.size() / 64 + (in[0] % 4U) * 256U + std::size_t{in[1]};
        const std::size_t count = std::min<std::size_t>(in[2], in.size() - 3);
        in = in.subspan(3);
        if (count == 0) {
            file.resize(std::min(file.size(), at));
            break;
        }
        for (std::size_t i = 0; i < count && at + i < file.size(); ++i)
            file[at + i] = in[i];
        in = in.subspan(count);
    }
    putChecksum(file);
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> kWhole = EnlargerLearner().stored("fuzz");
    try {
        const EnlargerLearner learner =
            EnlargerLearner::restored(edited(kWhole, {data, size}), "fuzz", "file");
        test::requireThat(learner.filters() != nullptr,
                          "the learner has no filters after it read its state");
        test::requireThat(std::isfinite(learner.counts().gainDb),
                          "the learned gain in dB is not finite");
    } catch (const FilterBankError&) {
        return 0;
    }
    return 0;
}
