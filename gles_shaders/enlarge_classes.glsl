// Finds the two classes of a pixel for the learned enlarger: one by its gradient, one by its
// curvature. Classes are numbered as in GradientClasses and CurvatureClasses in
// pipeline/enlarge/filter_layout.h. Needs pipeline/engine/params/enlarge.h.

// Returns the bin of an angle a; see Symmetry in pipeline/enlarge/filter_layout.h. `cosine`,
// `sine`: cosine and sine of 2a, times the same positive factor. `inQuadrant`: number of the bin,
// counted from 2a = 0, in which 2a would be if cosine and sine were both positive.
int angleBin(float cosine, float sine, int inQuadrant, int bins) {
    bool left = cosine < 0.0, lower = sine < 0.0;
    int bin = left != lower ? bins / 2 - 1 - inQuadrant : inQuadrant;
    return lower ? bin : bin + bins / 2;
}

int gradientClass(vec3 sums) {
    float scale = 2.0 * 25.0 * float(4 * kLumaScale * kLumaScale);
    float cosine = sums.x - sums.z, sine = 2.0 * sums.y, sum = sums.x + sums.z;
    float spread = sqrt(cosine * cosine + sine * sine);
    vec3 strengths = scale * vec3(kWeakFrom * kWeakFrom, kMediumFrom * kMediumFrom, kStrongFrom * kStrongFrom);
    vec2 roots = vec2(kPartlyCoherentFrom, kCoherentFrom);
    // The structure tensor has the eigenvalues s1^2 and s2^2. Their sum is `sum`, their difference
    // is `spread`. The thresholds `roots` of the coherence (s1 - s2) / (s1 + s2) are converted to
    // thresholds of `spread`.
    vec2 coherences = sum * 2.0 * roots / (1.0 + roots * roots);
    int kind = int(dot(step(strengths, vec3(sum + spread)), vec3(3.0)) + dot(step(coherences, vec2(spread)), vec2(1.0)));
    float c = abs(cosine), s = abs(sine);
    int bin = int(s > c) + int(s > c * kLowTangent) + int(s > c * kHighTangent);
    return angleBin(cosine, sine, bin, kGradientAngles) * kGradientKinds + kind;
}

// Returns the class of a pixel by its second derivatives [1/8 grey level per px^2]. `fourXy` is
// four times the mixed derivative.
int curvatureClass(float xx, float yy, float fourXy) {
    float cosine = xx - yy, sine = 0.5 * fourXy, scale = float(kLumaScale);
    float square = cosine * cosine + sine * sine;
    vec3 laplacians = scale * vec3(kLowLaplacian, kMediumLaplacian, kHighLaplacian);
    vec3 differences = scale * vec3(kLowDifference, kMediumDifference, kHighDifference);
    vec3 laplacian = vec3(xx + yy);
    int kind = int(dot(step(laplacians, laplacian) + step(-laplacians, laplacian), vec3(4.0)) +
                   dot(step(differences * differences, vec3(square)), vec3(1.0)));
    int bin = abs(sine) > abs(cosine) ? 1 : 0;
    return angleBin(cosine, sine, bin, kCurvatureAngles) * kCurvatureKinds + kind;
}
