// Which tiles have most structure. Needs counts, noise, matched and measured[] of plan_dispatch.comp.

const int kStructureBins = 84;  // a quarter of an octave

// Of the tile and those beside it, as the weight of a cell looks beyond its tile.
float structureAround(int x, int y) {
    float most = 0.0;
    for (int j = max(y - 1, 0); j <= min(y + 1, counts.x / counts.w - 1); ++j)
        for (int i = max(x - 1, 0); i <= min(x + 1, counts.w - 1); ++i)
            most = max(most, measured[2 * (j * counts.w + i)].z);
    return most;
}

int structureBin(float structure) {
    return clamp(int(4.0 * log2(structure + 1.0)), 0, kStructureBins - 1);
}

// Marks tiles in w; the least bin of structure that leaves at most as many as are wanted.
int leastStructure() {
    int histogram[kStructureBins];
    for (int i = 0; i < kStructureBins; ++i) histogram[i] = 0;
    for (int i = 0; i < counts.x; ++i) {
        float around = structureAround(i % counts.w, i / counts.w);
        measured[2 * i].w = around;
        if (around > noise.y) histogram[structureBin(around)]++;
    }
    int above = 0, bin = kStructureBins;
    while (bin > 0 && above + histogram[bin - 1] <= matched.x) above += histogram[--bin];
    return bin;
}
