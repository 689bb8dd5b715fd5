// samples/ contains the drivers' statistics of this shader. The shader reads a texture and adds to
// storage inside a loop, and once more after the loop.
layout(local_size_x = 4, local_size_y = 4) in;
layout(std430, binding = 0) buffer Sums {
    int count;
    float sums[];
};
layout(binding = 0) uniform sampler2D picture;

void main() {
    int at = int(gl_GlobalInvocationID.x);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) sum += texelFetch(picture, ivec2(i, at), 0).r * sums[at + i];
    sums[at] = sum;
}
