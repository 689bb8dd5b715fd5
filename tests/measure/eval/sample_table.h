#pragma once

#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/sample_run.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mfar::eval {

struct SampleRow {
    const std::string& label;
    const FlowSample& sample;
    const std::string& method;
};

/// Runs the requested methods on every sample of the folders and adds the means.
/// `factory.create(name, rig)` makes a new method for each folder. `samplesOf(folder)` finds the
/// samples, `truthOf(set, sample)` loads the truth. `addRow(row, result, truth)` compares them and
/// adds a row.
template <class Factory, class SamplesOf, class TruthOf, class AddRow>
void measureSamples(const SampleRequest& request, const SamplesOf& samplesOf,
                    const TruthOf& truthOf, const AddRow& addRow, Report& report) {
    Factory factory;
    const auto labels = labelsOf(request.folders);
    for (std::size_t f = 0; f < labels.size(); ++f) {
        const SampleRun run(request, request.folders[f], labels[f], samplesOf(request.folders[f]));
        std::vector<decltype(factory.create(labels[f], run.set().rig))> methods;
        for (const std::string& name : request.methods)
            methods.push_back(factory.create(name, run.set().rig));
        const ProgressPart progress = request.progress.part(f, labels.size(), labels[f]);
        const std::size_t count = run.set().samples.size();
        std::size_t done = 0;
        run.each(
            [&](const Shot& still) {
                for (const auto& method : methods)
                    method->setStill(still);
            },
            [&](const FlowSample& sample, const Shot& frame) {
                progress.show(done, count, frameOf(done, count));
                ++done;
                const auto truth = truthOf(run.set(), sample);
                for (std::size_t i = 0; i < methods.size(); ++i)
                    addRow(SampleRow{run.label(), sample, request.methods[i]},
                           methods[i]->run(frame), truth);
            });
    }
    report.addMeans();
}

}  // namespace mfar::eval
