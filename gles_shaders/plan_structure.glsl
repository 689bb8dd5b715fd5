// Which tiles have most structure. Needs counts, noise, matched, tiles[], measured[] and kWorkers of
// plan_dispatch.comp.

const int kStructureBins = 84;  // a quarter of an octave
const float kKept = 1.19;

shared uint structureBins[kStructureBins];  // tiles

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

// Marks tiles in w. Those that were matched count as a bin more: noise must not make detail come and go.
void countStructure(int worker) {
    for (int i = worker; i < counts.x; i += kWorkers) {
        float around = structureAround(i % counts.w, i / counts.w) * (tiles[i].y != 0u ? kKept : 1.0);
        measured[2 * i].w = around;
        if (around > noise.y) atomicAdd(structureBins[structureBin(around)], 1u);
    }
}

// The least bin of structure that leaves at most as many as are wanted.
int leastStructure() {
    uint above = 0u;
    int bin = kStructureBins;
    while (bin > 0 && above + structureBins[bin - 1] <= uint(matched.x)) above += structureBins[--bin];
    return bin;
}
