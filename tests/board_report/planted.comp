// Drivers cannot keep this shader's large local array in registers, so they place the array in
// memory. The budget check must report this.
layout(local_size_x = 4, local_size_y = 4) in;
layout(std430, binding = 0) buffer Values {
    float values[];
};

void main() {
    int at = int(gl_GlobalInvocationID.x);
    float kept[160];
    for (int i = 0; i < 160; ++i) kept[i] = values[at * 160 + i];
    float sum = 0.0;
    for (int i = 0; i < 160; ++i) sum = sum * 0.5 + kept[i] * kept[159 - i];
    for (int i = 0; i < 160; ++i) values[at * 160 + (i * 7) % 160] = kept[i] + sum;
}
